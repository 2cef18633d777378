// Error vectors: a quad for each, in which the distance to the arrow's outline decides how much of
// a pixel is covered. The head grows with the arrow, up to a point.

struct Arrow {
    @builtin(position) position: vec4f,
    // From the tail along the arrow, and across, pixels.
    @location(0) local: vec2f,
    // Length, length of the head, width, pixels.
    @location(1) @interpolate(flat) form: vec3f,
    @location(2) @interpolate(flat) color: vec4f,
}

const CORNERS = array<vec2f, 6>(
    vec2f(0.0, -1.0), vec2f(1.0, -1.0), vec2f(1.0, 1.0),
    vec2f(0.0, -1.0), vec2f(1.0, 1.0), vec2f(0.0, 1.0),
);

fn drawn(corner: u32, from_mm: vec3f, vector: vec3f, width_pt: f32, color: vec4f) -> Arrow {
    var arrow: Arrow;
    arrow.position = nowhere();
    let tail = px_of(from_mm);
    let along = frame.to_px.xy * flat_of(vector) * frame.shown.y;
    let length_px = length(along);
    let point = frame.size.z;
    if !(length_px >= 0.75 * point && length_px < 1e6) {
        return arrow;
    }
    let width = width_pt * point;
    let head = clamp(0.35 * length_px, point, 6.0 * point + width);
    let u = along / length_px;
    let v = vec2f(-u.y, u.x);
    let half = 0.5 * max(head, width) + 1.0;
    let place = CORNERS[corner];
    let local = vec2f(mix(-1.0, length_px + 1.0, place.x), half * place.y);
    let tip = from_mm + vector * frame.shown.y;
    let depth = mix(depth_of(from_mm), depth_of(tip), place.x);
    arrow.position = clip_of(tail + local.x * u + local.y * v, depth);
    arrow.local = local;
    arrow.form = vec3f(length_px, head, width);
    arrow.color = faded(color, depth_of(from_mm));
    return arrow;
}

@vertex
fn arrow(@builtin(vertex_index) corner: u32, sample: Sample) -> Arrow {
    let shown = shown_of(sample.before, sample.after);
    if !known(shown) || !known(sample.at) {
        var none: Arrow;
        none.position = nowhere();
        return none;
    }
    return drawn(corner, sample.at - shown, shown, frame.style.z, frame.flat_color);
}

// The deviation before, where another is shown.
@vertex
fn ghost(@builtin(vertex_index) corner: u32, sample: Sample) -> Arrow {
    if !known(sample.before) || !known(sample.at) {
        var none: Arrow;
        none.position = nowhere();
        return none;
    }
    return drawn(corner, sample.at - sample.before, sample.before, 1.0, frame.ghost);
}

@fragment
fn covered(arrow: Arrow) -> @location(0) vec4f {
    let p = arrow.local;
    let length_px = arrow.form.x;
    let head = arrow.form.y;
    let neck = length_px - head;
    let across = abs(p.y);
    let shaft = max(across - 0.5 * arrow.form.z, max(-p.x, p.x - neck));
    // The head's side goes from the tip to half its length beside the neck.
    let side = (0.5 * (p.x - length_px) + across) / 1.118034;
    let triangle = max(neck - p.x, side);
    // Both meet at the neck, where each covers the part that the other leaves.
    let coverage = clamp(0.5 - shaft, 0.0, 1.0) + clamp(0.5 - triangle, 0.0, 1.0);
    if coverage < 0.004 {
        discard;
    }
    return output_of(arrow.color, min(coverage, 1.0));
}
