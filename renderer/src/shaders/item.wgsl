// Item buffer: one id a triangle. Vertices come in the frame of the face (right, up, forward).

// Distance of the near plane in metres; ITEM_NEAR in item_buffer.rs says why.
override near: f32;

struct Corner {
    @builtin(position) clip: vec4<f32>,
    @location(0) @interpolate(flat, either) id: u32,
}

// Opening angle 90 degrees, so no arithmetic: depth = near / forward, reversed, far plane at infinity.
@vertex
fn corner(@location(0) local: vec3<f32>, @location(1) id: u32) -> Corner {
    return Corner(vec4<f32>(local.xy, near, local.z), id);
}

@fragment
fn item(in: Corner) -> @location(0) u32 {
    return in.id;
}
