// What all layers share: where things go in this frame, and what colours they have.

struct Frame {
    right: vec4f,
    up: vec4f,
    // Pixels per mm to the right and down; where the middle of the cloud is, pixels.
    to_px: vec4f,
    // Width and height of the plot, pixels; pixels per point; 1 where the target wants linear colours.
    size: vec4f,
    // From before to after; magnification; last the tolerance, mm, below 0: none.
    shown: vec4f,
    // Behind nothing: whether there is an answer; width of vectors, points; size of marks.
    style: vec4f,
    // How much colour what is farthest loses, last.
    style_2: vec4f,
    // The plot's left and upper edge on the screen, pixels.
    corner: vec4f,
    flat_color: vec4f,
    ghost: vec4f,
    measured: vec4f,
    within: vec4f,
    outside: vec4f,
    surface: vec4f,
    warning: vec4f,
    // Towards the viewer; what a mm is of the whole depth, 0 where depth does not count.
    towards: vec4f,
}

@group(0) @binding(0) var<uniform> frame: Frame;

// A vector of the measuring frame as it lies in the plane.
fn flat_of(v: vec3f) -> vec2f {
    return vec2f(dot(frame.right.xyz, v), dot(frame.up.xyz, v));
}

// Pixels of the plot, from its upper left corner.
fn px_of(p: vec3f) -> vec2f {
    return frame.to_px.zw + frame.to_px.xy * flat_of(p);
}

// From 0, nearest to the viewer, to 1.
fn depth_of(p: vec3f) -> f32 {
    return clamp(0.5 - frame.towards.w * dot(frame.towards.xyz, p), 0.0, 1.0);
}

fn clip_of(px: vec2f, depth: f32) -> vec4f {
    let half = px / frame.size.xy;
    return vec4f(2.0 * half.x - 1.0, 1.0 - 2.0 * half.y, depth, 1.0);
}

// A colour at a depth: what is far comes nearer to what it stands on.
fn faded(color: vec4f, depth: f32) -> vec4f {
    let part = frame.style_2.w * clamp(2.0 * depth - 0.5, 0.0, 1.0);
    return vec4f(mix(color.rgb, frame.surface.rgb, part), color.a);
}

// Beyond the far plane: vertices there are clipped.
fn nowhere() -> vec4f {
    return vec4f(2.0, 2.0, 2.0, 1.0);
}

// Whether a number is one: neither infinite nor none.
fn known(v: vec3f) -> bool {
    let size = max(abs(v.x), max(abs(v.y), abs(v.z)));
    return size < 1e30 && v.x == v.x && v.y == v.y && v.z == v.z;
}

// The deviation that is shown; without an answer nothing is known of the one after.
fn shown_of(before: vec3f, after: vec3f) -> vec3f {
    if frame.style.y < 0.5 {
        return before;
    }
    return mix(before, after, frame.shown.x);
}

fn linear_of(c: vec3f) -> vec3f {
    return select(pow((c + 0.055) / 1.055, vec3f(2.4)), c / 12.92, c <= vec3f(0.04045));
}

// Premultiplied, as egui blends.
fn output_of(color: vec4f, coverage: f32) -> vec4f {
    let rgb = select(color.rgb, linear_of(color.rgb), frame.size.w > 0.5);
    let alpha = color.a * coverage;
    return vec4f(rgb * alpha, alpha);
}

// One triangle that covers the whole plot.
@vertex
fn everywhere(@builtin(vertex_index) corner: u32) -> @builtin(position) vec4f {
    let x = select(-1.0, 3.0, corner == 1u);
    let y = select(-1.0, 3.0, corner == 2u);
    return vec4f(x, y, 0.0, 1.0);
}

// What there is for each sample, as `cloud` lays it out; positions and deviations in mm.

struct Sample {
    @location(0) at: vec3f,
    @location(1) before: vec3f,
    @location(2) after: vec3f,
    @location(3) suspected: f32,
}

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

const ALONG = array<vec2f, 6>(
    vec2f(0.0, -1.0), vec2f(1.0, -1.0), vec2f(1.0, 1.0),
    vec2f(0.0, -1.0), vec2f(1.0, 1.0), vec2f(0.0, 1.0),
);

fn arrow_of(corner: u32, from_mm: vec3f, vector: vec3f, width_pt: f32, color: vec4f) -> Arrow {
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
    let place = ALONG[corner];
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
    return arrow_of(corner, sample.at - shown, shown, frame.style.z, frame.flat_color);
}

// The deviation before, where another is shown.
@vertex
fn ghost(@builtin(vertex_index) corner: u32, sample: Sample) -> Arrow {
    if !known(sample.before) || !known(sample.at) {
        var none: Arrow;
        none.position = nowhere();
        return none;
    }
    return arrow_of(corner, sample.at - sample.before, sample.before, 1.0, frame.ghost);
}

@fragment
fn arrow_covers(arrow: Arrow) -> @location(0) vec4f {
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

const AROUND = array<vec2f, 6>(
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
    mark.local = half * AROUND[corner];
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
fn mark_covers(mark: Mark) -> @location(0) vec4f {
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

// A picture that was drawn before, pixel by pixel.

@group(1) @binding(0) var picture: texture_2d<f32>;

@fragment
fn copied(@builtin(position) position: vec4f) -> @location(0) vec4f {
    let px = vec2i(position.xy - frame.corner.xy);
    return textureLoad(picture, px, 0);
}
