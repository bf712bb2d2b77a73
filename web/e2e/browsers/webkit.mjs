/**
 * WebKitGTK, which has Safari's engines, by WebDriver: Debian's MiniBrowser in a session that keeps nothing. It wants a
 * display, which xvfb-run gives.
 */
import { spawn } from 'node:child_process';

const program = process.env.MINIBROWSER ?? '/usr/lib/x86_64-linux-gnu/webkit2gtk-4.1/MiniBrowser';
// The driver takes no port that was in use a minute ago.
let nextPort = 20_000 + (process.pid % 20_000);

/** Of a system without a language WebKit tells pages one that JavaScript does not know. */
const environment = { LANG: 'en_US.UTF-8', LIBGL_ALWAYS_SOFTWARE: '1' };

export async function openWebKit() {
  const port = nextPort++;
  const driver = spawn('WebKitWebDriver', [`--port=${port}`], {
    stdio: 'ignore',
    env: { ...process.env, ...environment },
  });
  const ended = new Promise((_, failed) => {
    driver.once('error', failed);
    driver.once('exit', (code) => failed(new Error(`WebKitWebDriver ended with ${code}`)));
  });
  ended.catch(() => undefined);
  const ask = async (method, path, body) => {
    const response = await fetch(`http://127.0.0.1:${port}${path}`, {
      method,
      body: body && JSON.stringify(body),
    });
    const { value } = await response.json();
    if (!response.ok) throw new Error(`${value.error}: ${value.message}`);
    return value;
  };
  const listens = async () => {
    while (!(await ask('GET', '/status').catch(() => null)))
      await new Promise((later) => setTimeout(later, 100));
  };
  await Promise.race([listens(), ended]);
  const options = { binary: program, args: ['--automation'] };
  const { sessionId, capabilities } = await ask('POST', '/session', {
    capabilities: { alwaysMatch: { 'webkitgtk:browserOptions': options } },
  });
  const session = `/session/${sessionId}`;
  return {
    name: `WebKitGTK ${capabilities.browserVersion}`,
    goto: (address) => ask('POST', `${session}/url`, { url: address }),
    evaluate: (expression) =>
      ask('POST', `${session}/execute/sync`, { script: `return ${expression}`, args: [] }),
    async close() {
      await ask('DELETE', session).catch(() => undefined);
      driver.kill();
    },
  };
}
