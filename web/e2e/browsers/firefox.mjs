/** Firefox by its own protocol, WebDriver BiDi: a page in a fresh profile, in which expressions are evaluated. */
import { spawn } from 'node:child_process';
import { mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';

/** Preferences of a quiet profile whose drawing is done by software. */
const preferences = `user_pref("webgl.force-enabled", true);
user_pref("browser.shell.checkDefaultBrowser", false);
user_pref("datareporting.policy.dataSubmissionEnabled", false);
user_pref("toolkit.telemetry.reportingpolicy.firstRun", false);
user_pref("app.normandy.enabled", false);
user_pref("browser.safebrowsing.downloads.remote.enabled", false);
`;

/** Answers of one socket, by the numbers of what they answer. */
async function connect(url) {
  const socket = new WebSocket(url);
  await new Promise((opened, failed) => {
    socket.onopen = opened;
    socket.onerror = () => failed(new Error(`${url} does not answer`));
  });
  const waiting = new Map();
  socket.onmessage = ({ data }) => {
    const { id, result, error, message } = JSON.parse(data);
    const asked = waiting.get(id);
    waiting.delete(id);
    if (error) asked?.failed(new Error(`${error}: ${message}`));
    else asked?.done(result);
  };
  let count = 0;
  const ask = (method, params = {}) =>
    new Promise((done, failed) => {
      waiting.set(++count, { done, failed });
      socket.send(JSON.stringify({ id: count, method, params }));
    });
  return { ask, close: () => socket.close() };
}

export async function openFirefox() {
  const profile = mkdtempSync(join(tmpdir(), 'voxtet-firefox-'));
  writeFileSync(join(profile, 'user.js'), preferences);
  const args = ['--profile', profile, '--no-remote', '--headless', '--remote-debugging-port', '0'];
  const browser = spawn('firefox-esr', args, { env: { ...process.env, LIBGL_ALWAYS_SOFTWARE: '1' } });
  const url = await new Promise((found, failed) => {
    let said = '';
    browser.stderr.on('data', (text) => {
      said += text;
      const [, address] = /WebDriver BiDi listening on (ws:\S+)/.exec(said) ?? [];
      if (address) found(`${address}/session`);
    });
    browser.once('error', failed);
    browser.once('exit', (code) => failed(new Error(`Firefox ended with ${code}: ${said}`)));
  });
  const { ask, close } = await connect(url);
  const { capabilities } = await ask('session.new', { capabilities: {} });
  const { contexts } = await ask('browsingContext.getTree');
  const { context } = contexts[0];
  return {
    name: `Firefox ${capabilities.browserVersion}`,
    goto: (address) => ask('browsingContext.navigate', { context, url: address, wait: 'interactive' }),
    async evaluate(expression) {
      const { result, exceptionDetails } = await ask('script.evaluate', {
        expression,
        target: { context },
        awaitPromise: true,
      });
      if (exceptionDetails) throw new Error(exceptionDetails.text);
      return result.value;
    },
    async close() {
      await ask('browser.close').catch(() => undefined);
      close();
      await new Promise((ended) => (browser.exitCode === null ? browser.once('exit', ended) : ended()));
      rmSync(profile, { recursive: true, force: true });
    },
  };
}
