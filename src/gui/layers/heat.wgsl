// The heat map: mean products of the deviations before and after in cells, between whose middles
// they are linear.

@group(1) @binding(0) var cells: texture_2d<f32>;

fn cell(x: i32, y: i32) -> vec4f {
    return textureLoad(cells, vec2i(x, y), 0);
}

fn heat_at(px: vec2f) -> vec4f {
    let mm = (px - frame.to_px.zw) / frame.to_px.xy;
    let place = (mm - frame.grid.xy) * frame.grid.z;
    let whole = floor(place);
    if !(all(whole >= vec2f(0.0)) && all(whole + 1.0 < frame.grid_size.xy)) {
        return vec4f(0.0);
    }
    let first = vec2i(whole);
    let part = place - whole;
    let below = mix(cell(first.x, first.y), cell(first.x + 1, first.y), part.x);
    let above = mix(cell(first.x, first.y + 1), cell(first.x + 1, first.y + 1), part.x);
    let mean = mix(below, above, part.y);
    let t = frame.shown.x;
    let squared = (1.0 - t) * (1.0 - t) * mean.x + 2.0 * t * (1.0 - t) * mean.y + t * t * mean.z;
    let part_of_long = sqrt(max(squared, 0.0)) / frame.shown.z;
    return output_of(scale_of(part_of_long), mean.w * frame.style_2.z);
}

// A fragment knows only where it is on the screen.
@fragment
fn covered(@builtin(position) position: vec4f) -> @location(0) vec4f {
    return heat_at(position.xy - vec2f(frame.grid.w, frame.grid_size.z));
}
