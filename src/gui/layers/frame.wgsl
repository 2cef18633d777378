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

// What nobody sees.
fn nowhere() -> vec4f {
    return vec4f(2.0, 2.0, 2.0, 1.0);
}

// Whether a number is one: neither infinite nor none.
fn known(v: vec3f) -> bool {
    let size = max(abs(v.x), max(abs(v.y), abs(v.z)));
    return size < 1e30 && v.x == v.x && v.y == v.y && v.z == v.z;
}

// The deviation that is shown.
fn shown_of(before: vec3f, after: vec3f) -> vec3f {
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
