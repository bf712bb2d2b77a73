/** The system's Chromium, drawing by software; no browser is downloaded. */
export const port = Number(process.env.VOXTET_PORT ?? 8137);

export const browserUse = {
  baseURL: `http://127.0.0.1:${port}/`,
  // Kept files would stand between the pages and what tests do to their requests. hosts.spec.ts is about them.
  serviceWorkers: 'block' as const,
  viewport: { width: 1280, height: 800 },
  launchOptions: {
    executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium',
    args: [
      '--no-sandbox',
      '--use-gl=angle',
      '--use-angle=swiftshader',
      '--enable-unsafe-swiftshader',
      '--disable-quic',
      '--no-first-run',
      '--disable-background-networking',
      '--disable-component-update',
      '--disable-sync',
    ],
  },
};
