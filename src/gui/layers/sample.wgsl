// What there is for each sample, as `cloud` lays it out; positions and deviations in mm.

struct Sample {
    @location(0) at: vec3f,
    @location(1) before: vec3f,
    @location(2) after: vec3f,
    @location(3) suspected: f32,
    @location(4) uncertain: f32,
}

// Whether colour says anything but before and after.
fn colour_says() -> bool {
    return frame.style.x > 0.5;
}

// The uncertainty, where colour says it, from 0 to 1; below 0: it is not known, or colour says something else.
fn uncertainty_of(sample: Sample) -> f32 {
    return select(-1.0, sample.uncertain, frame.style.x > 1.5);
}

// What colour says of a sample of which this deviation is shown; transparent where nothing is known.
fn said_of(shown: vec3f, sample: Sample) -> vec4f {
    if colour_says() && frame.style.x < 1.5 {
        return scale_of(length(shown) / frame.shown.z);
    }
    let part = uncertainty_of(sample);
    if part < 0.0 {
        return vec4f(0.0);
    }
    return scale_of(part);
}

