// Measured points: a disc, or an open diamond outside the tolerance, and a ring around what is
// suspected.

struct Mark {
    @builtin(position) position: vec4f,
    // From the middle, points.
    @location(0) local: vec2f,
    // 0: a point; 1: within; 2: outside. 1 where suspected.
    @location(1) @interpolate(flat) kind: vec2f,
    @location(2) @interpolate(flat) depth: f32,
}

const CORNERS = array<vec2f, 6>(
    vec2f(-1.0, -1.0), vec2f(1.0, -1.0), vec2f(1.0, 1.0),
    vec2f(-1.0, -1.0), vec2f(1.0, 1.0), vec2f(-1.0, 1.0),
);

@vertex
fn mark(@builtin(vertex_index) corner: u32, sample: Sample) -> Mark {
    var mark: Mark;
    mark.position = nowhere();
    if !known(sample.at) {
        return mark;
    }
    var kind = 0.0;
    let shown = shown_of(sample.before, sample.after);
    if frame.shown.w >= 0.0 {
        kind = select(2.0, 1.0, length(shown) <= frame.shown.w);
    }
    let marked = sample.suspected > 0.5 && frame.style.y > 0.5;
    let half = select(5.0 * frame.style.w, 8.75, marked) + 1.0;
    mark.local = half * CORNERS[corner];
    let depth = depth_of(sample.at);
    mark.position = clip_of(px_of(sample.at) + mark.local * frame.size.z, depth);
    mark.depth = depth;
    mark.kind = vec2f(kind, select(0.0, 1.0, marked));
    return mark;
}

fn covers(outside_points: f32) -> f32 {
    return clamp(0.5 - outside_points * frame.size.z, 0.0, 1.0);
}

@fragment
fn covered(mark: Mark) -> @location(0) vec4f {
    let size = frame.style.w;
    let far = length(mark.local);
    let thin = min(1.0, size + 0.25);
    var out = vec4f(0.0);
    if mark.kind.x < 1.5 {
        let within = mark.kind.x > 0.5;
        let radius = select(2.6, 2.8, within) * size;
        let color = faded(select(frame.measured, frame.within, within), mark.depth);
        out = output_of(color, covers(far - radius));
    } else {
        let edge = (abs(mark.local.x) + abs(mark.local.y) - 4.2 * size) * 0.70710678;
        let fill = output_of(frame.surface, covers(edge));
        let stroke = output_of(frame.outside, covers(abs(edge) - 0.7 * thin));
        out = stroke + fill * (1.0 - stroke.a);
    }
    let ring = mark.kind.y * covers(abs(far - 8.0) - 0.75);
    let around = output_of(frame.warning, ring);
    let all = around + out * (1.0 - around.a);
    // What covers nothing is not in the way of what is behind it.
    if all.a < 0.004 {
        discard;
    }
    return all;
}
