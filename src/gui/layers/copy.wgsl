// A picture that was drawn before, pixel by pixel.

@group(1) @binding(0) var picture: texture_2d<f32>;

@fragment
fn covered(@builtin(position) position: vec4f) -> @location(0) vec4f {
    let px = vec2i(position.xy - frame.corner.xy);
    return textureLoad(picture, px, 0);
}
