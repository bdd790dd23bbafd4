// Perspective picture: sun with soft shadows, light from the sky, haze. Positions are relative to
// the eye.

struct Globals {
    // Camera axes; right and up divided by the tangents of half the opening angles.
    right: vec4<f32>,
    up: vec4<f32>,
    forward: vec4<f32>,
    // Camera axes times those tangents, for the sky.
    ray_right: vec4<f32>,
    ray_up: vec4<f32>,
    // Sun's view: axis, and offset in w; each coordinate runs from -1 to 1, depth from 0 to 1.
    light_right: vec4<f32>,
    light_up: vec4<f32>,
    light_depth: vec4<f32>,
    // Direction to the sun; in w the size of a shadow texel in metres.
    sun: vec4<f32>,
    // Linear colours; in horizon.w the distance of the haze in metres.
    horizon: vec4<f32>,
    zenith: vec4<f32>,
}

@group(0) @binding(0) var<uniform> globals: Globals;
@group(0) @binding(1) var shadow_map: texture_depth_2d;
@group(0) @binding(2) var shadow_sampler: sampler_comparison;

const NEAR: f32 = 0.05;

struct Vertex {
    @location(0) position: vec3<f32>,
    @location(1) normal: vec3<f32>,
    // Linear, straight alpha.
    @location(2) color: vec4<f32>,
    @location(3) surface: u32,
}

struct Corner {
    @builtin(position) clip: vec4<f32>,
    @location(0) position: vec3<f32>,
    @location(1) normal: vec3<f32>,
    @location(2) color: vec4<f32>,
    @location(3) @interpolate(flat, either) surface: u32,
}

struct Pixel {
    @location(0) color: vec4<f32>,
    // Surface number, and its normal with how clear the air is before it: for the outlines.
    @location(1) surface: vec2<u32>,
}

fn light_space(position: vec3<f32>) -> vec3<f32> {
    let p = vec4<f32>(position, 1.0);
    return vec3<f32>(
        dot(globals.light_right, p),
        dot(globals.light_up, p),
        dot(globals.light_depth, p),
    );
}

@vertex
fn shadow_corner(@location(0) position: vec3<f32>) -> @builtin(position) vec4<f32> {
    return vec4<f32>(light_space(position), 1.0);
}

@vertex
fn corner(in: Vertex) -> Corner {
    let clip = vec4<f32>(
        dot(globals.right.xyz, in.position),
        dot(globals.up.xyz, in.position),
        NEAR,
        dot(globals.forward.xyz, in.position),
    );
    return Corner(clip, in.position, in.normal, in.color, in.surface);
}

// Share of the sun that arrives: 9 filtered samples.
fn sunlight(position: vec3<f32>, normal: vec3<f32>) -> f32 {
    let at = light_space(position + normal * globals.sun.w * 1.5);
    let uv = vec2<f32>(at.x, -at.y) * 0.5 + 0.5;
    if any(uv < vec2<f32>(0.0)) || any(uv > vec2<f32>(1.0)) {
        return 1.0;
    }
    let texel = 1.0 / vec2<f32>(textureDimensions(shadow_map));
    // Ground beyond the last feature is farther than the map is deep: what hides it is not.
    let depth = min(at.z, 1.0);
    var lit = 0.0;
    for (var dx = -1; dx <= 1; dx++) {
        for (var dy = -1; dy <= 1; dy++) {
            let by = vec2<f32>(f32(dx), f32(dy)) * texel;
            lit += textureSampleCompareLevel(shadow_map, shadow_sampler, uv + by, depth);
        }
    }
    return lit / 9.0;
}

fn sky_color(direction: vec3<f32>) -> vec3<f32> {
    let height = clamp(direction.z, 0.0, 1.0);
    return mix(globals.horizon.rgb, globals.zenith.rgb, sqrt(height));
}

@fragment
fn surface(in: Corner) -> Pixel {
    // Both sides are seen: the normal faces the eye.
    let n = normalize(in.normal) * select(1.0, -1.0, dot(in.normal, in.position) > 0.0);
    let slope = max(dot(n, globals.sun.xyz), 0.0);
    let sun = vec3<f32>(0.78, 0.74, 0.66) * slope * sunlight(in.position, n);
    let sky = mix(vec3<f32>(0.30, 0.29, 0.28), vec3<f32>(0.36, 0.39, 0.44), n.z * 0.5 + 0.5);
    let lit = in.color.rgb * (sun + sky);
    let clear = exp(-length(in.position) / globals.horizon.w);
    let color = mix(globals.horizon.rgb, lit, clear);
    return Pixel(
        vec4<f32>(color, in.color.a),
        vec2<u32>(in.surface, pack4x8snorm(vec4<f32>(n, clear))),
    );
}

struct Ray {
    @builtin(position) clip: vec4<f32>,
    @location(0) direction: vec3<f32>,
}

// One triangle that covers the picture.
@vertex
fn sky_corner(@builtin(vertex_index) index: u32) -> Ray {
    let x = f32(index & 1u) * 4.0 - 1.0;
    let y = f32(index >> 1u) * 4.0 - 1.0;
    let ray = globals.forward.xyz + x * globals.ray_right.xyz + y * globals.ray_up.xyz;
    return Ray(vec4<f32>(x, y, 0.0, 1.0), ray);
}

@fragment
fn sky(in: Ray) -> Pixel {
    return Pixel(vec4<f32>(sky_color(normalize(in.direction)), 1.0), vec2<u32>(0u, 0u));
}
