// How points are drawn: shape, size and brightness say the class, too, for those who do not see the colours apart.
// Added: larger, full discs. Removed: larger rings, through which one sees. All else: small squares, darker far away.

import { type Color, GLSL3, Matrix4, RawShaderMaterial, Vector2 } from 'three';
import { type Palette } from './palette';

const kVertex = /* glsl */ `
  precision highp float;
  in vec4 record; // x, y, z in steps; class + 256 * intensity
  uniform mat4 modelMatrix, viewMatrix, projectionMatrix;
  uniform vec3 classColours[7];
  uniform vec3 ground;
  uniform vec2 heights_m;   // where shading by height begins and ends
  uniform float farFade_m;  // so far away points are half as bright
  uniform float focal_px;
  uniform float pixelRatio;
  uniform float side;       // -1: before, 0: both, 1: after
  uniform vec2 swipe;       // x in normalised device coordinates; y: 1 when there is a swipe
  uniform mat4 boxFromScene;
  uniform float focused;    // 1: what changed elsewhere is dimmed
  flat out vec3 colour;
  flat out int shape;
  void main() {
    int pointClass = min(int(mod(record.w, 256.0)), 6);
    vec4 scene = modelMatrix * vec4(record.xyz, 1.0);
    vec4 eye = viewMatrix * scene;
    gl_Position = projectionMatrix * eye;
    float depth_m = max(-eye.z, 0.001);
    if (swipe.y * side * (gl_Position.x - swipe.x * gl_Position.w) < 0.0) gl_Position = vec4(2.0, 2.0, 2.0, 1.0);

    bool changed = pointClass >= 1 && pointClass <= 3;
    // What changed lies in front of what it stands on, or stood on.
    if (changed) gl_Position.z -= 0.0003 * gl_Position.w;
    vec3 inBox = abs((boxFromScene * scene).xyz);
    bool elsewhere = focused > 0.5 && max(inBox.x, max(inBox.y, inBox.z)) > 1.0;
    float size = clamp(focal_px * 0.035 / depth_m, 1.5, 6.0);
    if (pointClass >= 4) size *= 0.8;
    if (changed && !elsewhere) size = max(size * 1.7, 4.5);
    gl_PointSize = size * pixelRatio;

    float height = clamp((scene.z - heights_m.x) / max(heights_m.y - heights_m.x, 0.01), 0.0, 1.0);
    float light = changed ? 1.0 : 0.7 + 0.45 * height;
    float fade = changed ? 0.0 : 0.7 * (1.0 - farFade_m / (farFade_m + depth_m));
    colour = mix(classColours[pointClass] * light, ground, elsewhere && changed ? 0.55 : fade);
    shape = !changed || gl_PointSize < 3.0 ? 0 : pointClass;
  }
`;

const kFragment = /* glsl */ `
  precision highp float;
  flat in vec3 colour;
  flat in int shape;
  out vec4 fragment;
  void main() {
    vec2 at = 2.0 * gl_PointCoord - 1.0;
    float r = dot(at, at);
    if (shape == 1 && r > 1.0) discard;
    if (shape == 2 && (r > 1.0 || r < 0.28)) discard;
    if (shape == 3 && abs(at.x) + abs(at.y) > 1.0) discard;
    float rim = shape == 1 && r > 0.62 ? 0.6 : 1.0;
    fragment = vec4(colour * rim, 1.0);
  }
`;

export interface PointUniforms {
  readonly swipe: { value: Vector2 };
  readonly side: { value: number };
  readonly heights_m: { value: Vector2 };
  readonly farFade_m: { value: number };
  readonly focal_px: { value: number };
  readonly pixelRatio: { value: number };
  readonly boxFromScene: { value: Matrix4 };
  readonly focused: { value: number };
  readonly classColours: { value: readonly Color[] };
  readonly ground: { value: Color };
}

export function pointsMaterial(
  palette: Palette,
  swipe: { value: Vector2 },
): { material: RawShaderMaterial; uniforms: PointUniforms } {
  const uniforms: PointUniforms = {
    swipe,
    side: { value: 0 },
    heights_m: { value: new Vector2(0, 1) },
    farFade_m: { value: 50 },
    focal_px: { value: 800 },
    pixelRatio: { value: 1 },
    boxFromScene: { value: new Matrix4() },
    focused: { value: 0 },
    classColours: { value: palette.classes },
    ground: { value: palette.ground },
  };
  const material = new RawShaderMaterial({
    glslVersion: GLSL3,
    vertexShader: kVertex,
    fragmentShader: kFragment,
    uniforms: { ...uniforms },
  });
  return { material, uniforms };
}
