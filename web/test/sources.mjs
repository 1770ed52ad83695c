// The sources of the page as modules, for tests without a browser. The program's argument is the folder of
// node_modules; it exits with 77 where there are none.
import { existsSync } from 'node:fs'
import { createRequire } from 'node:module'
import { fileURLToPath } from 'node:url'

const packages = process.argv[2]
if (!existsSync(`${packages}/node_modules/esbuild`)) process.exit(77)
const { buildSync } = createRequire(`${packages}/`)('esbuild')

/** A source by its name. */
export async function source(name) {
  const path = fileURLToPath(new URL(`../src/${name}.ts`, import.meta.url))
  const settings = { bundle: true, format: 'esm', write: false, nodePaths: [`${packages}/node_modules`] }
  const { outputFiles } = buildSync({ entryPoints: [path], ...settings })
  return import(`data:text/javascript,${encodeURIComponent(outputFiles[0].text)}`)
}
