// A WebGL 2 that draws nothing, for browser tests of what a 3D page does rather than shows: software
// draws a frame in a second on few cores. Every call succeeds at once. `blindCalls` counts them, and
// `blindBytes` what they would send to the graphics card.
;(() => {
  const NUMBERS = { MAX_TEXTURE_IMAGE_UNITS: 16, MAX_VERTEX_TEXTURE_IMAGE_UNITS: 16, MAX_SAMPLES: 4,
    MAX_TEXTURE_SIZE: 4096, MAX_CUBE_MAP_TEXTURE_SIZE: 4096, MAX_VERTEX_ATTRIBS: 16,
    MAX_VERTEX_UNIFORM_VECTORS: 1024, MAX_VARYING_VECTORS: 30, MAX_FRAGMENT_UNIFORM_VECTORS: 1024,
    MAX_COMBINED_TEXTURE_IMAGE_UNITS: 32, MAX_UNIFORM_BUFFER_BINDINGS: 24, MAX_ARRAY_TEXTURE_LAYERS: 256 }
  const constants = WebGL2RenderingContext
  const named = (value) => Object.keys(NUMBERS).find((name) => constants[name] === value)
  const canvasSize = (size) => Math.max(size, 1)
  window.blindCalls = 0
  window.blindBytes = 0
  const TEXEL = 4

  // the data of a call: an array, of it a part where the call says so, or a picture
  function bytesOf(name, values) {
    const data = values.find((value) => ArrayBuffer.isView(value) || value?.width !== undefined)
    if (data === undefined) return 0
    if (!ArrayBuffer.isView(data)) return data.width * data.height * TEXEL
    const length = name === 'bufferSubData' ? (values[4] ?? 0) : 0
    return length > 0 ? length * data.BYTES_PER_ELEMENT : data.byteLength
  }

  function answers(canvas, attributes) {
    const precision = { precision: 23, rangeMin: 127, rangeMax: 127 }
    return {
      canvas,
      drawingBufferColorSpace: 'srgb',
      getContextAttributes: () => attributes,
      makeXRCompatible: () => Promise.resolve(),
      isContextLost: () => false,
      getExtension: () => null,
      getSupportedExtensions: () => [],
      getShaderPrecisionFormat: () => precision,
      getShaderParameter: () => true,
      getProgramParameter: (_, what) =>
        what === constants.LINK_STATUS || what === constants.DELETE_STATUS ? true : 0,
      getShaderInfoLog: () => '',
      getProgramInfoLog: () => '',
      getShaderSource: () => '',
      getUniformLocation: () => null,
      getAttribLocation: () => -1,
      getUniformBlockIndex: () => 0,
      getError: () => 0,
      checkFramebufferStatus: () => constants.FRAMEBUFFER_COMPLETE,
      getParameter: (what) => {
        if (what === constants.VERSION) return 'WebGL 2.0'
        if (what === constants.SHADING_LANGUAGE_VERSION) return 'WebGL GLSL ES 3.00'
        if (what === constants.VIEWPORT || what === constants.SCISSOR_BOX) {
          return new Int32Array([0, 0, canvas.width, canvas.height])
        }
        return NUMBERS[named(what)] ?? 0
      },
      get drawingBufferWidth() {
        return canvasSize(canvas.width)
      },
      get drawingBufferHeight() {
        return canvasSize(canvas.height)
      },
    }
  }

  function blind(canvas, attributes) {
    const context = answers(canvas, attributes)
    const nothing = () => {
      window.blindCalls++
    }
    const sends = (name) => (...values) => {
      window.blindCalls++
      window.blindBytes += bytesOf(name, values)
    }
    for (const name of Object.getOwnPropertyNames(constants.prototype)) {
      if (name in context || name === 'constructor') continue
      if (name in constants) context[name] = constants[name]
      else if (name.startsWith('create')) context[name] = () => ({})
      else context[name] = /^(tex|buffer)(Sub)?(Image|Data|Storage)/.test(name) ? sends(name) : nothing
    }
    return context
  }

  const real = HTMLCanvasElement.prototype.getContext
  HTMLCanvasElement.prototype.getContext = function (kind, attributes = {}) {
    if (kind !== 'webgl2') return real.call(this, kind, attributes)
    this.blind ??= blind(this, attributes)
    return this.blind
  }
})()
