import { defineConfig, mergeConfig } from 'vitest/config'
import pages, { noLoader } from './vite.config.ts'

// The code of a page that `mrlab show` writes: one classic script and one style sheet, since a page
// opened from file:// may load no module.
export default mergeConfig(
  pages,
  defineConfig({
    publicDir: false,
    resolve: { alias: { 'three/examples/jsm/libs/meshopt_decoder.module.js': noLoader } },
    build: {
      outDir: 'dist/show',
      emptyOutDir: true,
      cssCodeSplit: false,
      lib: {
        entry: 'src/show.tsx',
        formats: ['iife'],
        name: 'mrlab',
        fileName: () => 'show.js',
        cssFileName: 'show',
      },
      rolldownOptions: { output: { codeSplitting: false } },
    },
  }),
)
