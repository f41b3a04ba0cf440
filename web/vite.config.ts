import { defineConfig } from 'vitest/config'

// The gateway serves the pages below /; hashed names below /static/ are cached for ever.
export default defineConfig({
  build: {
    target: 'es2022',
    assetsDir: 'static',
    // Fonts and pictures stay files: the content security policy allows no data: URL.
    assetsInlineLimit: 0,
    modulePreload: { polyfill: false },
    reportCompressedSize: true,
  },
  oxc: { jsx: { runtime: 'automatic', importSource: 'preact' } },
  test: { include: ['test/**/*.test.{ts,tsx}'] },
})
