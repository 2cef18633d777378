// What there is for each sample, as `cloud` lays it out; positions and deviations in mm.

struct Sample {
    @location(0) at: vec3f,
    @location(1) before: vec3f,
    @location(2) conditions: vec3f,
    @location(3) after: vec3f,
    @location(4) suspected: f32,
    @location(5) uncertain: f32,
}

// Whether colour says anything but before and after.
fn colour_says() -> bool {
    return frame.style.x > 0.5;
}

// The condition or the uncertainty that colour says, from 0 to 1; below 0: none is known, or it says
// something else.
fn condition_of(sample: Sample) -> f32 {
    let says = u32(frame.style.x);
    if says == 6u {
        return sample.uncertain;
    }
    return select(-1.0, sample.conditions[clamp(says, 3u, 5u) - 3u], says >= 3u);
}

// What colour says of a sample of which this deviation is shown; transparent where nothing is known.
fn said_of(shown: vec3f, sample: Sample) -> vec4f {
    let says = u32(frame.style.x);
    if says == 1u {
        return scale_of(length(shown) / frame.shown.z);
    }
    if says == 2u {
        let flat_vector = flat_of(shown);
        return scale_of(atan2(flat_vector.y, flat_vector.x) / TURN);
    }
    let part = condition_of(sample);
    if part < 0.0 {
        return vec4f(0.0);
    }
    return scale_of(part);
}

