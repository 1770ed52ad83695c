import { readFileSync } from 'node:fs'
import { defineConfig } from 'vite'
import { viteSingleFile } from 'vite-plugin-singlefile'

/** `REHEARSE_DATA=FILE.json npm run dev` shows this data; a built page gets its own from `rehearse report`. */
function dataWhileDeveloping() {
  return {
    name: 'data-while-developing',
    apply: 'serve',
    transformIndexHtml: (html) =>
      html.replace('REHEARSE_REPORT_DATA', () =>
        readFileSync(process.env.REHEARSE_DATA, 'utf8').replaceAll('<', '\\u003c'),
      ),
  }
}

export default defineConfig({
  plugins: [dataWhileDeveloping(), viteSingleFile({ removeViteModuleLoader: true })],
  build: { target: 'es2022', modulePreload: false, reportCompressedSize: false },
})
