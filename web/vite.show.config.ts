import { defineConfig, mergeConfig } from 'vitest/config'
import pages, { noLoader } from './vite.config.ts'

// The code of a page that `mrlab show` or `mrlab class` writes: one classic script and one style
// sheet, since a page opened from file:// may load no module. --mode flat: without the 3D view.
export default defineConfig(({ mode }) => {
  const name = mode === 'flat' ? 'flat' : 'show'
  return mergeConfig(pages, {
    publicDir: false,
    resolve: { alias: { 'three/examples/jsm/libs/meshopt_decoder.module.js': noLoader } },
    build: {
      outDir: `dist/${name}`,
      emptyOutDir: true,
      cssCodeSplit: false,
      lib: {
        entry: name === 'flat' ? 'src/show_flat.ts' : 'src/show_3d.ts',
        formats: ['iife'],
        name: 'mrlab',
        fileName: () => `${name}.js`,
        cssFileName: name,
      },
      rolldownOptions: { output: { codeSplitting: false } },
    },
  })
})
