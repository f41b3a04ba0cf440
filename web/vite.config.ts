import { fileURLToPath } from 'node:url'
import { defineConfig } from 'vitest/config'

const noLoader = fileURLToPath(new URL('src/scene/no_loader.ts', import.meta.url))

// The gateway serves the pages below /; hashed names below /static/ are cached for ever.
export default defineConfig({
  build: {
    target: 'es2022',
    assetsDir: 'static',
    // Fonts and pictures stay files: the content security policy allows no data: URL.
    assetsInlineLimit: 0,
    modulePreload: { polyfill: false },
    // Which file imports which: the budgets of bytes are held from it.
    manifest: true,
    reportCompressedSize: true,
  },
  resolve: {
    // urdf-loader imports both for its own way of reading meshes, which is not used: 23 kB.
    alias: {
      'three/examples/jsm/loaders/STLLoader.js': noLoader,
      'three/examples/jsm/loaders/ColladaLoader.js': noLoader,
    },
  },
  oxc: { jsx: { runtime: 'automatic', importSource: 'preact' } },
  test: { include: ['test/**/*.test.{ts,tsx}'] },
})
