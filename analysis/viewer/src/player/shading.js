/**
 * The light on cloth, obstacles and the floor: the light of printed figures (analysis/draw/render.py), whose
 * constants are in the page's data. Colours in shaders are linear until the last line.
 */
import { DataTexture, DoubleSide, GLSL3, LinearFilter, RGBAFormat, ShaderMaterial, UnsignedByteType,
         Vector3 } from "three";

const LIT = /* glsl */`
  uniform vec3 light;
  uniform sampler2DShadow shadowMap;
  uniform mat4 shadowMatrix;
  uniform float shadowTexel;
  uniform bool shadowed;

  // Share of the light that arrives, from samples on a disc. Each pixel turns the disc by another angle.
  float lightAt(vec3 point, float radius, float bias, int taps) {
    if (!shadowed) return 1.0;
    vec3 place = (shadowMatrix * vec4(point, 1.0)).xyz;
    if (any(lessThan(place.xy, vec2(0.0))) || any(greaterThan(place.xy, vec2(1.0)))) return 1.0;
    if (taps == 1) return texture(shadowMap, vec3(place.xy, place.z - bias));
    float turn = 6.2832 * fract(52.9829189 * fract(dot(gl_FragCoord.xy, vec2(0.06711056, 0.00583715))));
    float total = 0.0;
    for (int i = 0; i < taps; ++i) {
      float angle = float(i) * 2.39996 + turn, far = sqrt((float(i) + 0.5) / float(taps)) * radius * shadowTexel;
      total += texture(shadowMap, vec3(place.xy + far * vec2(cos(angle), sin(angle)), place.z - bias));
    }
    return total / float(taps);
  }

  vec3 lit(vec3 base, vec3 normal, vec3 toEye, float arriving, float through) {
    float facing = dot(normal, light);
    float direct = clamp((facing + 0.12) / 1.12, 0.0, 1.0) * (0.25 + 0.75 * arriving);
    float ambient = 0.34 + 0.10 * normal.z + 0.12 * dot(normal, toEye);
    float gloss = 0.10 * arriving * pow(clamp(dot(normal, normalize(light + toEye)), 0.0, 1.0), 24.0);
    return base * 0.92 * (ambient + 0.78 * direct + through * clamp(-facing, 0.0, 1.0)) + 0.6 * gloss;
  }
  vec4 shown(vec3 linear) { return vec4(pow(clamp(linear, 0.0, 1.0), vec3(1.0 / 2.2)), 1.0); }
`;

const VERTEX = /* glsl */`
  out vec3 vPoint, vNormal;
  void main() {
    vPoint = (modelMatrix * vec4(position, 1.0)).xyz;
    vNormal = normal;
    gl_Position = projectionMatrix * viewMatrix * vec4(vPoint, 1.0);
  }
`;

/** The uniforms that all materials of a view share. @param {object} colours of the page's data */
export function lighting(colours) {
  return { light: { value: new Vector3(...colours.light) }, shadowMap: { value: null },
           shadowMatrix: { value: null }, shadowTexel: { value: 1 }, size: { value: 1 },
           taps: { value: 8 }, shadowed: { value: true } };
}

const material = (light, vertexShader, fragmentShader, uniforms = {}, more = {}) => new ShaderMaterial({
  glslVersion: GLSL3, uniforms: { ...light, ...uniforms }, vertexShader, fragmentShader, ...more });

/** A cloth with a value for each triangle; without a `map` it has one colour. */
export function clothMaterial(light, colours) {
  return material(light, /* glsl */`
    in float value;
    out vec3 vPoint, vNormal, vCorner;
    out float vValue;
    void main() {
      vPoint = (modelMatrix * vec4(position, 1.0)).xyz;
      vNormal = normal;
      vValue = value;
      int corner = gl_VertexID % 3;
      vCorner = vec3(corner == 0, corner == 1, corner == 2);
      gl_Position = projectionMatrix * viewMatrix * vec4(vPoint, 1.0);
    }`, /* glsl */`
    ${LIT}
    uniform sampler2D map;
    uniform vec2 range;
    uniform bool logarithmic, coloured, lines;
    uniform vec3 back, plain;
    uniform float size;
    uniform int taps;
    in vec3 vPoint, vNormal, vCorner;
    in float vValue;
    layout(location = 0) out vec4 colour;
    void main() {
      vec3 toEye = normalize(cameraPosition - vPoint);
      vec3 base = plain;
      if (coloured && vValue == vValue) {
        float share = logarithmic ? log(max(vValue, 1e-30) / range.x) / log(range.y / range.x)
                                  : (vValue - range.x) / (range.y - range.x);
        base = pow(texture(map, vec2(clamp(share, 0.0, 1.0) * (255.0 / 256.0) + 0.5 / 256.0, 0.5)).rgb, vec3(2.2));
      }
      vec3 normal = normalize(vNormal);
      if (!gl_FrontFacing) { normal = -normal; base *= back; }
      if (lines) {
        vec3 width = fwidth(vCorner);
        vec3 near = vCorner / max(width, 1e-6);
        float pixels = min(min(near.x, near.y), near.z);
        float strength = clamp((1.0 / max(max(width.x, width.y), width.z) - 5.0) / 18.0, 0.0, 1.0);
        base *= 1.0 - 0.32 * strength * clamp(1.1 - pixels, 0.0, 1.0);
      }
      float arriving = lightAt(vPoint + 0.006 * size * normal, 1.6, 0.002, taps);
      colour = shown(lit(base, normal, toEye, arriving, 0.22));
    }`, {
    map: { value: null }, range: { value: null }, logarithmic: { value: false }, coloured: { value: false },
    lines: { value: true }, back: { value: new Vector3(...colours.back) },
    plain: { value: new Vector3(...PLAIN) } }, { side: DoubleSide });
}

/** A cloth whose triangles share corners, without lines, and with the uniforms of a clothMaterial(). */
export function quickClothMaterial(cloth) {
  const flat = (text) => text.replace(/\b(in|out) float vValue;/, "flat $1 float vValue;");
  return new ShaderMaterial({ glslVersion: GLSL3, side: DoubleSide, uniforms: cloth.uniforms,
    vertexShader: flat(cloth.vertexShader).replace(/(out vec3 vPoint, vNormal), vCorner;/, "$1;")
      .replace(/int corner =[^;]*;\s*vCorner =[^;]*;/, ""),
    fragmentShader: flat(cloth.fragmentShader).replace(/(in vec3 vPoint, vNormal), vCorner;/, "$1;")
      .replace(/if \(lines\) \{[^}]*\}/, "") });
}

export const PLAIN = [0.80, 0.775, 0.715]; // linear; close to the low end of the stretch colours

/** The cloth of the other run in a comparison: pale glass with an outline. */
export function ghostMaterial(light) {
  return material(light, VERTEX, /* glsl */`
    uniform vec3 tint;
    in vec3 vPoint, vNormal;
    layout(location = 0) out vec4 colour;
    void main() {
      vec3 toEye = normalize(cameraPosition - vPoint);
      float edge = 1.0 - abs(dot(normalize(vNormal), toEye));
      colour = vec4(tint, 0.10 + 0.65 * edge * edge * edge);
    }`, { tint: { value: new Vector3(0.04, 0.37, 0.65) } },
    { side: DoubleSide, transparent: true, depthWrite: false });
}

export function obstacleMaterial(light, colours) {
  return material(light, VERTEX, /* glsl */`
    ${LIT}
    uniform vec3 base;
    uniform float size;
    uniform int taps;
    in vec3 vPoint, vNormal;
    layout(location = 0) out vec4 colour;
    void main() {
      vec3 toEye = normalize(cameraPosition - vPoint);
      vec3 normal = normalize(cross(dFdx(vPoint), dFdy(vPoint)));
      vec3 smoothed = normalize(vNormal);
      if (dot(smoothed, toEye) < 0.0) smoothed = -smoothed;
      if (dot(normal, smoothed) > 0.5) normal = smoothed;
      if (dot(normal, toEye) < 0.0) normal = -normal;
      float arriving = lightAt(vPoint + 0.006 * size * normal, 1.6, 0.002, taps);
      colour = shown(lit(base, normal, toEye, arriving, 0.0));
    }`, { base: { value: new Vector3(...colours.obstacle.map((c) => c ** 2.2)) } }, { side: DoubleSide });
}

/** A horizontal floor that shows only the shadow, and fades out at some distance. */
export function floorMaterial(light) {
  return material(light, VERTEX, /* glsl */`
    ${LIT}
    uniform float size;
    uniform vec3 middle;
    uniform int taps;
    in vec3 vPoint, vNormal;
    layout(location = 0) out vec4 colour;
    void main() {
      if (cameraPosition.z < vPoint.z) discard;
      float fade = clamp(1.0 - (length(vPoint.xy - middle.xy) / size - 1.2) / 1.3, 0.0, 1.0);
      float dark = 1.0 - lightAt(vPoint, 16.0, 0.0, taps == 1 ? 1 : taps * 2);
      colour = vec4(vec3(0.03, 0.04, 0.06), 0.26 * fade * dark);
    }`, { middle: { value: new Vector3() } }, { transparent: true, depthWrite: false, side: DoubleSide });
}

/** The material for the shadow map, which needs only the depth. */
export function shadowMaterial() {
  return new ShaderMaterial({
    glslVersion: GLSL3, side: DoubleSide, colorWrite: false,
    vertexShader: "void main() { gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0); }",
    fragmentShader: "layout(location = 0) out vec4 colour; void main() { colour = vec4(1.0); }" });
}

/** 256 hexadecimal colours as a texture. */
export function mapTexture(hex) {
  const data = new Uint8Array(4 * 256).fill(255);
  for (let i = 0; i < 256; ++i)
    for (let c = 0; c < 3; ++c) data[4 * i + c] = parseInt(hex.substr(6 * i + 2 * c, 2), 16);
  const texture = new DataTexture(data, 256, 1, RGBAFormat, UnsignedByteType);
  texture.minFilter = texture.magFilter = LinearFilter;
  texture.needsUpdate = true;
  return texture;
}
