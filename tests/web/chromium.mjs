// Chromium by its DevTools protocol, over a pipe: no library, and no port.
import { spawn } from 'node:child_process';
import { existsSync, mkdtempSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';

export const CHROMIUM = ['/usr/bin/chromium', '/usr/bin/chromium-browser', '/usr/bin/google-chrome'].find((path) => existsSync(path));

export class Chromium {
  #process; #folder; #ended; #next = 0; #waiting = new Map(); #session;
  messages = []; // what pages and their workers wrote to their consoles, and exceptions

  static async start() {
    const browser = new Chromium();
    browser.#folder = mkdtempSync(join(tmpdir(), 'simdbezier-chromium-'));
    browser.#process = spawn(CHROMIUM, ['--headless=new', '--no-sandbox', '--disable-dev-shm-usage', '--remote-debugging-pipe', '--no-first-run',
      '--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--ignore-gpu-blocklist', `--user-data-dir=${browser.#folder}`, 'about:blank'],
    { stdio: ['ignore', 'ignore', 'ignore', 'pipe', 'pipe'] });
    // It may end before it has answered, also when it was asked to.
    browser.#ended = new Promise((resolve) => browser.#process.once('exit', resolve)).then(() => {
      for (const { reject } of browser.#waiting.values()) reject(new Error('Chromium has ended'));
    });
    browser.#process.stdio[3].on('error', () => {}); // it has ended, which the line above says
    let rest = '';
    browser.#process.stdio[4].setEncoding('utf8').on('data', (text) => {
      const parts = (rest + text).split('\0');
      rest = parts.pop();
      parts.forEach((part) => browser.#take(JSON.parse(part)));
    });
    const { targetInfos } = await browser.call('Target.getTargets');
    const { targetId } = targetInfos.find(({ type }) => type === 'page');
    ({ sessionId: browser.#session } = await browser.call('Target.attachToTarget', { targetId, flatten: true }));
    for (const domain of ['Page', 'Runtime', 'Log', 'DOM']) await browser.call(`${domain}.enable`);
    return browser;
  }

  #take({ id, result, error, method, params }) {
    if (id !== undefined) {
      const { resolve, reject } = this.#waiting.get(id);
      this.#waiting.delete(id);
      error ? reject(new Error(`${error.message} ${error.data ?? ''}`)) : resolve(result);
    } else if (method === 'Runtime.consoleAPICalled') {
      this.messages.push(`${params.type}: ${params.args.map((value) => value.value ?? value.description).join(' ')}`);
    } else if (method === 'Runtime.exceptionThrown') {
      this.messages.push(`exception: ${params.exceptionDetails.exception?.description ?? params.exceptionDetails.text}`);
    } else if (method === 'Log.entryAdded') {
      this.messages.push(`${params.entry.level}: ${params.entry.text} ${params.entry.url ?? ''}`);
    }
  }

  call(method, params = {}) {
    const id = ++this.#next;
    this.#process.stdio[3].write(JSON.stringify({ id, method, params, sessionId: this.#session }) + '\0');
    return new Promise((resolve, reject) => this.#waiting.set(id, { resolve, reject }));
  }

  /** Returns the value of an expression in the page, or that of its promise. */
  async evaluate(expression) {
    const { result, exceptionDetails } = await this.call('Runtime.evaluate', { expression, awaitPromise: true, returnByValue: true });
    if (exceptionDetails) throw new Error(exceptionDetails.exception?.description ?? exceptionDetails.text);
    return result.value;
  }

  async until(expression, seconds = 60) {
    for (const end = Date.now() + 1000 * seconds; !(await this.evaluate(expression));) {
      if (Date.now() > end) throw new Error(`expected ${expression} within ${seconds} s\n${this.messages.join('\n')}`);
      await new Promise((resolve) => setTimeout(resolve, 50));
    }
  }

  async screenshot() {
    return Buffer.from((await this.call('Page.captureScreenshot')).data, 'base64');
  }

  async stop() {
    this.call('Browser.close').catch(() => {});
    await this.#ended;
    rmSync(this.#folder, { recursive: true, force: true, maxRetries: 5 });
  }
}
