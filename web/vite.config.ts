import { createReadStream } from 'node:fs'
import { fileURLToPath } from 'node:url'
import type { Plugin } from 'vite'
import { defineConfig } from 'vitest/config'

export const noLoader = fileURLToPath(new URL('src/scene/robot/no_loader.ts', import.meta.url))

// The gateway serves the pages below /; hashed names below /static/ are cached for ever.
/** Serve the package's own files where the gateway does, for `npm run dev -- --mode fake`. */
const serveAssets: Plugin = {
  name: 'assets',
  configureServer(server) {
    server.middlewares.use('/assets/mrlab_ros', (request, response) => {
      const place = new URL(`../.${request.url ?? ''}`, new URL(import.meta.url))
      createReadStream(fileURLToPath(place))
        .on('error', () => {
          response.statusCode = 404
          response.end()
        })
        .pipe(response)
    })
  },
}

export default defineConfig({
  plugins: [serveAssets],
  build: {
    target: 'es2022',
    assetsDir: 'static',
    // Fonts and pictures stay files: the content security policy allows no data: URL.
    assetsInlineLimit: 0,
    modulePreload: { polyfill: false },
    // Which file imports which: the budgets of bytes are held from it.
    manifest: true,
    reportCompressedSize: true,
    rolldownOptions: {
      output: {
        // One file for what every page begins with: each further one costs a phone a round trip.
        codeSplitting: {
          groups: [{ name: 'shell', test: /(preact|src\/(api|design|shell|words))\/(?!de|plot)/ }],
        },
      },
    },
    // The notices of the packages in the pages, as their licences ask for.
    license: { fileName: 'licences.md' },
  },
  resolve: {
    // urdf-loader imports both for its own way of reading meshes, which is not used: 23 kB.
    alias: {
      'three/examples/jsm/loaders/STLLoader.js': noLoader,
      'three/examples/jsm/loaders/ColladaLoader.js': noLoader,
    },
  },
  oxc: { jsx: { runtime: 'automatic', importSource: 'preact' } },
  // Files share a process and their imports: starting one for each took four times as long.
  test: { include: ['test/**/*.test.{ts,tsx}'], isolate: false },
})
