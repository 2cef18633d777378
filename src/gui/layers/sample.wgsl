// What there is for each sample, as `cloud` lays it out; positions and deviations in mm.

struct Sample {
    @location(0) at: vec3f,
    @location(1) before: vec3f,
    @location(2) after: vec3f,
    @location(3) suspected: f32,
}

// Whether colour says anything but before and after.
fn colour_says() -> bool {
    return frame.style.x > 0.5;
}

// What colour says of a sample of which this deviation is shown; transparent where it says nothing.
fn said_of(shown: vec3f) -> vec4f {
    return select(vec4f(0.0), scale_of(length(shown) / frame.shown.z), colour_says());
}

