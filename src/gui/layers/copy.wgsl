// A picture that was drawn before, pixel by pixel.

@group(1) @binding(0) var picture: texture_2d<f32>;

@vertex
fn everywhere(@builtin(vertex_index) corner: u32) -> @builtin(position) vec4f {
    let x = select(-1.0, 3.0, corner == 1u);
    let y = select(-1.0, 3.0, corner == 2u);
    return vec4f(x, y, 0.0, 1.0);
}

@fragment
fn covered(@builtin(position) position: vec4f) -> @location(0) vec4f {
    let px = vec2i(position.xy - vec2f(frame.grid.w, frame.grid_size.z));
    return textureLoad(picture, px, 0);
}
