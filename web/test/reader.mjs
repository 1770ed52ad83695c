// A reader with a browser, for browser.mjs. One browser and one page of it make all visits: to start either takes longer
// than most visits.
import assert from 'node:assert/strict'
import { readFileSync } from 'node:fs'
import { createRequire } from 'node:module'
import { pathToFileURL } from 'node:url'

/** WebGL without a graphics card; all else is drawn without WebGL, which would take several times as long. */
const FLAGS = ['--no-sandbox', '--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--disable-gpu-compositing']
/** A message of the driver, whatever a page does. */
const OF_THE_DRIVER = /GL Driver Message .*GPU stall due to ReadPixels/

export class Reader {
  static async start(executablePath, packages) {
    const { chromium } = createRequire(`${packages}/`)('playwright-core')
    const browser = await chromium.launch({ executablePath, args: FLAGS })
    // Without reduced motion the tests wait for the page to scroll.
    return new Reader(browser, await browser.newPage({ reducedMotion: 'reduce' }))
  }

  constructor(browser, page) {
    this.browser = browser
    this.page = page
    page.on('console', (message) => OF_THE_DRIVER.test(message.text()) || this.wrong.push(`console: ${message.text()}`))
    page.on('pageerror', (error) => this.wrong.push(`error: ${error.message}`))
    page.on('request', (request) => {
      if (request.url() !== this.url && !/^(data|blob):/.test(request.url()))
        this.wrong.push(`request: ${request.url()}`)
    })
  }

  /** Opens a page as a reader would and hands it to `visit`; nothing may have gone wrong when that ends. */
  async open(file, { viewport = { width: 1280, height: 900 }, colorScheme = 'light' }, visit) {
    this.wrong = []
    this.url = pathToFileURL(file).href
    await this.page.setViewportSize(viewport)
    await this.page.emulateMedia({ colorScheme })
    await this.page.goto(this.url)
    await this.page.waitForSelector('h1')
    await visit(this.page)
    await this.everyFigure()
    const overflow = await this.page.evaluate(() => document.documentElement.scrollWidth - window.innerWidth)
    assert.ok(overflow <= 0, `${file} is ${overflow} px wider than the window`)
    assert.deepEqual(this.wrong, [], file)
  }

  /** Every figure draws something when the reader comes to it. */
  async everyFigure() {
    for (const figure of await this.page.locator('figure').all()) {
      await figure.scrollIntoViewIfNeeded()
      await figure.locator('svg path, svg line, tbody tr').first().waitFor({ state: 'attached' })
    }
  }

  /** The text that the button of that name saves. */
  async saved(name) {
    const download = this.page.waitForEvent('download')
    const [file] = await Promise.all([download, this.page.getByRole('button', { name }).click()])
    return readFileSync(await file.path(), 'utf8')
  }

  /** From now on no page has WebGL. */
  async loseWebGL() {
    await this.page.addInitScript(() => {
      const { getContext } = HTMLCanvasElement.prototype
      HTMLCanvasElement.prototype.getContext = function (kind, ...rest) {
        return kind.startsWith('webgl') ? null : getContext.call(this, kind, ...rest)
      }
    })
  }

  async close() {
    await this.browser.close()
  }
}

/** Where the cursors of a trial's panels stand. */
export const cursors = (page) =>
  page.locator('#trajectory line.cursor').evaluateAll((lines) => lines.map((line) => line.getAttribute('x1')))
const robot = (page) => page.locator('.stage').innerHTML()

/** The slider moves the robot and the cursors, by mouse and by keyboard. */
export async function moveSlider(page) {
  const slider = page.getByRole('slider', { name: 'Time' })
  await slider.scrollIntoViewIfNeeded()
  await page.locator('#trajectory line.cursor').first().waitFor({ state: 'attached' })
  const before = [await robot(page), await cursors(page)]
  await slider.fill('20')
  const moved = [await robot(page), await cursors(page)]
  assert.notEqual(moved[0], before[0])
  assert.ok(before[1].length > 0 && moved[1].every((x, i) => x !== before[1][i]), 'a cursor stands still')
  await slider.press('ArrowRight')
  assert.equal(await slider.getAttribute('aria-valuetext'), '1.05 s')
  assert.notEqual(await robot(page), moved[0])
}

export async function play(page) {
  await page.getByRole('slider', { name: 'Time' }).fill('0')
  await page.getByRole('combobox', { name: 'Speed' }).selectOption('0.25×') // a busy machine looks seldom
  await page.getByRole('button', { name: 'Play' }).press('Enter')
  await page.getByText(/^0\.[1-9]\d \/ 2\.50 s$/).waitFor()
  await page.getByRole('button', { name: 'Pause' }).press('Enter')
}

/** The width of A4 with margins of 1 cm, in px. */
const PAPER = 718

/** Paper is light, has no controls, and cuts no table off; charts are no wider than it, and as before afterwards. */
export async function print(page) {
  const widths = () => page.locator('.panel svg').evaluateAll((all) => all.map((svg) => svg.width.baseVal.value))
  const says = (event) => page.evaluate((event) => window.dispatchEvent(new Event(event)), event)
  await says('beforeprint') // draws what the reader did not come to yet
  await says('afterprint')
  const [before, { width, height }] = [await widths(), page.viewportSize()]
  await says('beforeprint')
  await page.setViewportSize({ width: PAPER, height })
  await page.emulateMedia({ media: 'print' })
  assert.ok((await widths()).every((one) => one <= PAPER))
  const scheme = await page.evaluate(() => getComputedStyle(document.documentElement).colorScheme)
  assert.equal(scheme, 'light')
  assert.equal(await page.locator('button:visible, select:visible, nav:visible, input:visible').count(), 0)
  const heights = await page
    .locator('.scroll')
    .evaluateAll((all) => all.map((one) => [one.scrollHeight, one.clientHeight]))
  assert.ok(heights.every(([whole, shown]) => whole <= shown + 1))
  assert.match(await page.locator('.printed').textContent(), /^Trial \d+ at \d/)
  await page.emulateMedia({ media: 'screen' })
  await page.setViewportSize({ width, height })
  await says('afterprint')
  assert.deepEqual(await widths(), before)
}
