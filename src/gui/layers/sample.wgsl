// What there is for each sample, as `cloud` lays it out; positions and deviations in mm.

struct Sample {
    @location(0) at: vec3f,
    @location(1) before: vec3f,
    @location(2) after: vec3f,
    @location(3) suspected: f32,
}
