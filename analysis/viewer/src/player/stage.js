/** Draws all views of a player into one canvas: shadow, cloth, dark folds, marks. */
import { DepthTexture, GLSL3, LinearSRGBColorSpace, Mesh as Drawn, NearestFilter, OrthographicCamera, PlaneGeometry, Scene,
         ShaderMaterial, UnsignedIntType, Vector2, Vector3, Vector4, WebGLRenderer, WebGLRenderTarget,
         LinearFilter } from "three";

import { OVER } from "./view.js";

const FAST_MS = 18, SLOW_MS = 26; // ms per moving picture: faster pictures become finer, slower ones coarser
// Levels of detail, from cloth at rest to moving cloth on a slow machine. `ratio`: most pixels per pixel of
// the page. `rings` · `turns`: number of pairs of samples for dark folds. `taps`: number of samples of the
// shadow map. `shadow`: pixels on each side of the shadow map. `quick`: without mesh lines (cloth.js).
const LEVELS = [
  { ratio: 2, samples: 4, rings: 3, turns: 6, taps: 10, shadow: 1024, quick: false },
  { ratio: 1, samples: 0, rings: 2, turns: 3, taps: 4, shadow: 1024, quick: false },
  { ratio: 0.75, samples: 0, rings: 2, turns: 2, taps: 2, shadow: 512, quick: true },
  { ratio: 0.5, samples: 0, rings: 0, turns: 0, taps: 1, shadow: 512, quick: true }];
const MOST_QUICK = 50_000; // on a slow machine at most this many triangles throw a shadow while they move
const SOFTWARE = /swiftshader|llvmpipe|software|basic render/i;

export class Stage {
  constructor(canvas) {
    this.canvas = canvas;
    this.renderer = new WebGLRenderer({ canvas, antialias: false, alpha: false, powerPreference: "high-performance" });
    this.renderer.autoClear = false;
    this.renderer.outputColorSpace = LinearSRGBColorSpace; // shaders write the final colours
    this.renderer.setClearColor(0xffffff, 1);
    this.ground = { top: new Vector3(), bottom: new Vector3() };
    this.quad = new Drawn(new PlaneGeometry(2, 2), this.#composer());
    this.quad.frustumCulled = false;
    this.quadScene = new Scene();
    this.quadScene.add(this.quad);
    this.quadCamera = new OrthographicCamera(-1, 1, 1, -1, 0, 1);
    this.backdrop = new Drawn(new PlaneGeometry(2, 2), backdropMaterial(this.ground));
    this.backdrop.frustumCulled = false;
    this.backdropScene = new Scene();
    this.backdropScene.add(this.backdrop);
    this.movingLevel = SOFTWARE.test(this.#graphics()) ? LEVELS.length - 1 : 0;
    this.level = this.movingLevel; // the first picture is shown for a moment only
    this.finest = 0; // finest level that this machine can play
    this.times = [];
  }

  #graphics() {
    const gl = this.renderer.getContext();
    const more = gl.getExtension("WEBGL_debug_renderer_info");
    return more ? String(gl.getParameter(more.UNMASKED_RENDERER_WEBGL)) : "";
  }

  #composer() {
    return new ShaderMaterial({
      glslVersion: GLSL3, depthTest: false, depthWrite: false,
      uniforms: { picture: { value: null }, depth: { value: null }, near: { value: 1 }, far: { value: 1 },
                  size: { value: 1 }, texel: { value: new Vector2() }, bounds: { value: new Vector4() },
                  rings: { value: 3 }, turns: { value: 4 } },
      vertexShader: "out vec2 place; void main() { place = 0.5 * position.xy + 0.5; gl_Position = vec4(position.xy, 0.0, 1.0); }",
      // As in _occlusion() of analysis/draw/render.py: a pixel is dark if the mean of two pixels on opposite
      // sides is nearer to the camera than the pixel. So a plane is bright, whatever its direction.
      fragmentShader: /* glsl */`
        uniform sampler2D picture, depth;
        uniform float near, far, size;
        uniform vec2 texel;
        uniform vec4 bounds;
        uniform int rings, turns;
        in vec2 place;
        layout(location = 0) out vec4 colour;
        float depthAt(vec2 at) {
          float z = texture(depth, clamp(at, bounds.xy, bounds.zw)).r;
          return z >= 1.0 ? 1e9 : near * far / (far - z * (far - near));
        }
        void main() {
          vec2 at = mix(bounds.xy, bounds.zw, place);
          colour = vec4(texture(picture, at).rgb, 1.0);
          float here = depthAt(at);
          if (here > 1e8) return;
          float height = bounds.w - bounds.y, total = 0.0;
          float turned = 6.2832 * fract(52.9829189 * fract(dot(gl_FragCoord.xy, vec2(0.06711056, 0.00583715))));
          for (int r = 0; r < rings; ++r) {
            float reach = height * (r == 0 ? 0.010 : r == 1 ? 0.022 : 0.042);
            for (int k = 0; k < turns; ++k) {
              float angle = 3.14159 * (float(k) + turned / 6.2832) / float(turns) + float(r);
              vec2 shift = reach * vec2(cos(angle) * texel.x / texel.y, sin(angle));
              float one = here - depthAt(at + shift), other = here - depthAt(at - shift);
              if (abs(one) < 0.15 * size && abs(other) < 0.15 * size)
                total += clamp((one + other) / (0.012 * size), 0.0, 1.0);
            }
          }
          colour.rgb *= pow(1.0 - 0.72 * total / float(rings * turns), 1.0 / 2.2);
        }` });
  }

  /** In pixels of the page. */
  resize(width, height) {
    [this.width, this.height] = [width, height];
    this.#fit();
  }

  /** Gives the canvas the size for the present level of detail. */
  #fit() {
    this.ratio = Math.min(devicePixelRatio || 1, LEVELS[this.level].ratio);
    const size = [this.width, this.height].map((x) => Math.max(1, Math.round(x * this.ratio)));
    if (size[0] === this.canvas.width && size[1] === this.canvas.height) return;
    this.renderer.setPixelRatio(1);
    this.renderer.setSize(...size, false);
    this.#forget();
  }

  #forget() {
    this.target?.depthTexture.dispose();
    this.target?.dispose();
    this.target = null;
  }

  /** The render target for the cloth; null: the cloth is drawn on the canvas, without dark folds. */
  #targetOf({ samples, rings }) {
    if (!rings) return null;
    if (this.target?.samples !== samples) this.#forget();
    if (this.target) return this.target;
    const { width, height } = this.canvas;
    this.target = new WebGLRenderTarget(width, height, { samples, minFilter: LinearFilter, magFilter: LinearFilter });
    this.target.depthTexture = new DepthTexture(width, height, UnsignedIntType);
    this.target.depthTexture.minFilter = this.target.depthTexture.magFilter = NearestFilter;
    return this.target;
  }

  /**
   * @param {Array<{view: import("./view.js").View, x: number, y: number, width: number, height: number}>} cells in
   * pixels of the page, y from the top
   */
  draw(cells, moving = false) {
    const level = moving ? this.movingLevel : 0;
    if (level !== this.level) {
      this.level = level;
      this.#fit();
    }
    const { renderer, ratio } = this, how = LEVELS[level], target = this.#targetOf(how);
    for (const { view } of cells) {
      view.cloth.use(how.quick, view.scene);
      view.drawShadow(renderer, how.quick && view.mesh.triangleCount > MOST_QUICK ? 0 : how.shadow);
    }
    renderer.setRenderTarget(target);
    renderer.setScissorTest(false);
    renderer.setViewport(0, 0, this.canvas.width, this.canvas.height);
    renderer.clear();
    renderer.render(this.backdropScene, this.quadCamera);
    const boxes = cells.map(({ x, y, width, height }) => [Math.round(x * ratio),
      this.canvas.height - Math.round((y + height) * ratio), Math.round(width * ratio), Math.round(height * ratio)]);
    cells.forEach(({ view, width, height }, i) => {
      view.orbit.place(view.camera, view.anchor.centre, view.anchor.size, width / height);
      view.light.taps.value = how.taps;
      view.picked.resize(boxes[i][2], boxes[i][3], ratio);
      view.pinMarks.material.uniforms.ratio.value = ratio;
      this.#within(boxes[i], target);
      view.camera.layers.set(0);
      renderer.render(view.scene, view.camera);
      view.camera.layers.set(OVER);
      renderer.render(view.scene, view.camera);
    });
    if (target) this.#darkenFolds(cells, boxes, how);
  }

  /** Copies the picture to the canvas, and darkens folds. */
  #darkenFolds(cells, boxes, { rings, turns }) {
    const { renderer, canvas, target, quad: { material: { uniforms } } } = this;
    uniforms.rings.value = rings;
    uniforms.turns.value = turns;
    uniforms.picture.value = target.texture;
    uniforms.depth.value = target.depthTexture;
    uniforms.texel.value.set(1 / canvas.width, 1 / canvas.height);
    renderer.setRenderTarget(null);
    cells.forEach(({ view }, i) => {
      const [x, y, width, height] = boxes[i];
      uniforms.near.value = view.camera.near;
      uniforms.far.value = view.camera.far;
      uniforms.size.value = view.size;
      uniforms.bounds.value.set(x / canvas.width, y / canvas.height, (x + width) / canvas.width,
                                (y + height) / canvas.height);
      this.#within(boxes[i]);
      renderer.render(this.quadScene, this.quadCamera);
    });
  }

  #within([x, y, width, height], target = null) {
    if (target) {
      target.viewport.set(x, y, width, height);
      target.scissor.set(x, y, width, height);
      target.scissorTest = true;
      this.renderer.setRenderTarget(target);
    } else {
      this.renderer.setViewport(x, y, width, height);
      this.renderer.setScissor(x, y, width, height);
      this.renderer.setScissorTest(true);
    }
  }

  /** Adapts the detail of moving pictures to this machine. `took`: ms that a moving picture took. */
  judge(took) {
    this.times.push(took);
    if (this.times.length < 9) return;
    const median = this.times.sort((a, b) => a - b)[4];
    this.times = [];
    if (median > SLOW_MS && this.movingLevel < LEVELS.length - 1) this.finest = ++this.movingLevel;
    else if (median < FAST_MS && this.movingLevel > this.finest) --this.movingLevel;
  }

  dispose() {
    this.#forget();
    this.quad.geometry.dispose();
    this.quad.material.dispose();
    this.backdrop.geometry.dispose();
    this.backdrop.material.dispose();
    this.renderer.dispose();
    this.renderer.forceContextLoss();
  }
}

function backdropMaterial(ground) {
  return new ShaderMaterial({
    glslVersion: GLSL3, depthTest: false, depthWrite: false,
    uniforms: { top: { value: ground.top }, bottom: { value: ground.bottom } },
    vertexShader: "out float height; void main() { height = 0.5 * position.y + 0.5; gl_Position = vec4(position.xy, 1.0, 1.0); }",
    fragmentShader: /* glsl */`
      uniform vec3 top, bottom;
      in float height;
      layout(location = 0) out vec4 colour;
      void main() { colour = vec4(mix(bottom, top, height), 1.0); }` });
}
