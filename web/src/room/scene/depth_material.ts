import type { IUniform, Material } from 'three'

/** Uniforms of the room's depth. roomDepth: sampler2DArray, a layer for each eye. roomDepthView:
 * width and height of an eye's part of the picture, px, 0: no depth now; z: near plane of the
 * projection, m, or -(m of the value 1) of a depth without one; w: far plane, 0: infinite.
 * roomDepthLayer: of each eye. roomDepthFromView: mat4[2], from a place in an eye's part of the
 * picture to one of its depth. */
type DepthUniforms = Readonly<Record<string, IUniform>>

const DECLARED = /* glsl */ `
uniform highp sampler2DArray roomDepth;
uniform vec4 roomDepthView;
uniform vec2 roomDepthLayer;
uniform mat4 roomDepthFromView[2];

float realDepth(ivec3 at) {
  float raw = texelFetch(roomDepth, at, 0).r;
  float near = roomDepthView.z;
  float far = roomDepthView.w;
  if (near < 0.0) return raw > 0.0 ? -near * raw : 1e4;
  // No measurement.
  if (raw <= 0.0 || raw >= 1.0) return 1e4;
  return far > 0.0 ? near * far / (far - raw * (far - near)) : near / (1.0 - raw);
}

// 1: seen, 0: behind a real thing. What stands on a real table must not sink into it: the depth is
// off by a few per cent.
float seenBefore(ivec3 at, float own) {
  float real = realDepth(at);
  float slack = 0.02 + 0.02 * real;
  return 1.0 - smoothstep(slack, 2.0 * slack, own - real);
}

float seenInRoom() {
  if (roomDepthView.x <= 0.0) return 1.0;
  vec2 place = gl_FragCoord.xy / roomDepthView.xy;
  int eye = place.x >= 1.0 ? 1 : 0;
  place.x -= float(eye);
  place = (roomDepthFromView[eye] * vec4(place, 0.0, 1.0)).xy;
  ivec2 size = textureSize(roomDepth, 0).xy;
  vec2 texel = place * vec2(size) - 0.5;
  vec2 share = fract(texel);
  ivec2 low = clamp(ivec2(floor(texel)), ivec2(0), size - 1);
  ivec2 high = min(low + 1, size - 1);
  int layer = int(roomDepthLayer[eye]);
  // The results of the comparison are blended, not the depths: an edge keeps its place and is
  // soft.
  float own = 1.0 / gl_FragCoord.w;
  return mix(
    mix(seenBefore(ivec3(low, layer), own), seenBefore(ivec3(high.x, low.y, layer), own), share.x),
    mix(seenBefore(ivec3(low.x, high.y, layer), own), seenBefore(ivec3(high, layer), own), share.x),
    share.y);
}
`

const APPLIED = /* glsl */ `
float seen = seenInRoom();
if (seen < 0.01) discard;
#ifdef OPAQUE
  // An opaque material is not blended: its alpha lets the real room through.
  gl_FragColor *= seen;
#else
  gl_FragColor.a *= seen;
#endif
`

const AFTER = '#include <dithering_fragment>'
const patched = new WeakSet<Material>()

/** Have a lit material hidden behind real things. A material is changed once. */
export function hidden(material: Material, uniforms: DepthUniforms): void {
  if (patched.has(material)) return
  patched.add(material)
  const before = material.onBeforeCompile
  const key = `${material.customProgramCacheKey()}|depth`
  material.onBeforeCompile = (shader, renderer) => {
    before.call(material, shader, renderer)
    Object.assign(shader.uniforms, uniforms)
    const { fragmentShader } = shader
    if (!fragmentShader.includes(AFTER)) {
      throw new Error(`the shader of a ${material.type} has no '${AFTER}' to sample depth after`)
    }
    shader.fragmentShader = fragmentShader
      .replace('void main() {', `${DECLARED}\nvoid main() {`)
      .replace(AFTER, `${AFTER}\n${APPLIED}`)
  }
  material.customProgramCacheKey = () => key
  material.needsUpdate = true
}
