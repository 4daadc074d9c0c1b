// three.js carries the shaders of all of its materials. The scene draws with two: its own points (RawShaderMaterial), and
// lines (LineBasicMaterial, whose shaders three.js calls "basic"). The others are left out of what is sent to browsers, and
// so are the parts of its renderer that the scene has no use for: textures, shadows, lights, environments, headsets.

import { type Plugin } from 'vite';

const kept = ['meshbasic_vert', 'meshbasic_frag', 'tonemapping_pars_fragment', 'colorspace_pars_fragment'];
const table = /const ShaderChunk = \{([^}]*)\}/;

/** The chunks that are needed for those, by what they include. */
function needed(sources: ReadonlyMap<string, string>): Set<string> {
  const found = new Set<string>();
  const waiting = [...kept];
  while (waiting.length > 0) {
    const name = waiting.pop() ?? '';
    if (found.has(name)) continue;
    const source = sources.get(name);
    if (!source) throw new Error(`lean_three: three.js has no shader "${name}"; see web/scripts/lean_three.ts`);
    found.add(name);
    waiting.push(...[...source.matchAll(/#include <(\w+)>/g)].map((match) => match[1] ?? ''));
  }
  return found;
}

/** What two groups of a pattern hold, wherever it is found. */
const pairs = (text: string, pattern: RegExp): (readonly [string, string])[] =>
  [...text.matchAll(pattern)].map(([, first = '', second = '']) => [first, second]);

/** The module of three.js without the shaders of materials that nothing here uses. */
export function withoutUnusedShaders(code: string): string {
  const entries = pairs(table.exec(code)?.[1] ?? '', /(\w+): ([\w$]+)/g);
  const constants = new Map(pairs(code, /^(?:const|var) ([\w$]+) = ("(?:[^"\\]|\\.)*");/gm));
  const sources = new Map(entries.map(([name, constant]) => [name, constants.get(constant) ?? '']));
  const stays = needed(sources);
  const lean = entries.map(([name, constant]) => `${name}: ${stays.has(name) ? constant : "''"}`);
  return code.replace(table, () => `const ShaderChunk = {${lean.join(', ')}}`);
}

/** What stands in the place of a part: as much as the renderer asks of it when a scene has nothing for it. */
const standIns: Readonly<Record<string, string>> = {
  WebGLTextures: `function WebGLTextures() {
    const nothing = () => undefined;
    return { resetTextureUnits: nothing, getTextureUnits: nothing, setTextureUnits: nothing, dispose: nothing };
  }`,
  WebGLUtils: 'function WebGLUtils() { return { convert: () => null }; }',
  WebGLShadowMap: 'function WebGLShadowMap() { this.enabled = false; this.render = () => undefined; }',
  WebGLEnvironments: 'function WebGLEnvironments() { return { get: () => null, dispose: () => undefined }; }',
  WebGLMorphtargets: 'function WebGLMorphtargets() { return {}; }',
  WebGLUniformsGroups: 'function WebGLUniformsGroups() { return { dispose: () => undefined }; }',
  WebGLOutput: 'function WebGLOutput() {}',
  getDFGLUT: 'function getDFGLUT() { return null; }',
  WebXRManager: `class WebXRManager extends EventDispatcher {
    constructor() { super(); this.enabled = this.isPresenting = false; }
    getEnvironmentBlendMode() { return null; }
    setAnimationLoop() {}
    dispose() {}
  }`,
};

/** The module of three.js with those in the place of its own. */
export function withoutUnusedParts(code: string): string {
  return Object.entries(standIns).reduce((before, [name, standIn]) => {
    const after = before.replace(new RegExp(`^(function|class) ${name}\\b[^]*?^}`, 'm'), () => standIn);
    if (after === before) throw new Error(`lean_three: three.js has no "${name}"; see web/scripts/lean_three.ts`);
    return after;
  }, code);
}

export const leanThree = (): Plugin => ({
  name: 'lean-three',
  apply: 'build',
  transform: (code, id) =>
    id.endsWith('/three/build/three.module.js')
      ? { code: withoutUnusedParts(withoutUnusedShaders(code)), map: null }
      : null,
});
