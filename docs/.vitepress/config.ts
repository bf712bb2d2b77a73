import { fileURLToPath } from 'node:url';
import { defineConfig } from 'vitepress';
import { base, findBase, finish, relativePage } from './any_address';
import { withInserts } from './inserts';

const root = fileURLToPath(new URL('../..', import.meta.url));

/** Code stands as it is: colours of words would be styles in the page. */
const plainCode = (code: string) =>
  `<pre v-pre tabindex="0"><code>${code.replaceAll('&', '&amp;').replaceAll('<', '&lt;')}</code></pre>`;

const part = (text: string, folder: string, pages: [string, string][]) => ({
  text,
  items: pages.map(([title, page]) => ({ text: title, link: `/${folder}/${page}` })),
});

export default defineConfig({
  title: 'voxtet',
  description: 'From a segmented volume to a simulation-ready tetrahedral mesh, in a browser tab.',
  lang: 'en',
  srcExclude: ['README.md'],
  base,
  // Its transitions would be held by a style in the page.
  appearance: { disableTransition: false } as never,
  outDir: '../web/dist/docs',
  cacheDir: 'node_modules/.cache/vitepress',
  head: [findBase, ['link', { rel: 'icon', href: `${base}../icon.svg`, type: 'image/svg+xml' }]],
  metaChunk: true,
  transformHtml: (html, _, { page }) => relativePage(html, page),
  buildEnd: ({ outDir }) => finish(outDir),
  // Pictures keep their addresses: no attribute is made an import.
  vue: { template: { transformAssetUrls: { none: ['none'] } } },
  markdown: {
    highlight: plainCode,
    config: (md) => {
      md.core.ruler.before('normalize', 'inserts', (state) => {
        state.src = withInserts(state.src, root);
      });
    },
  },
  themeConfig: {
    logo: '/../icon.svg',
    search: { provider: 'local' },
    outline: [2, 3],
    nav: [
      { text: 'Start', link: '/start' },
      { text: 'Fields', link: '/reference/recipe' },
      { text: 'Commands', link: '/reference/command_line' },
      { text: 'Open the app', link: '/../', target: '_self' },
    ],
    sidebar: [
      { text: 'Start in two minutes', link: '/start' },
      part('How a mesh is made', 'stages', [
        ['Volume', 'volume'],
        ['Surface', 'surface'],
        ['Smooth', 'smooth'],
        ['Sizing', 'sizing'],
        ['Remesh', 'remesh'],
        ['Tetrahedra', 'tetrahedra'],
        ['Better shapes', 'optimise'],
        ['Quality', 'quality'],
      ]),
      part('On the mesh', 'stages', [
        ['Fibres', 'fibres'],
        ['Electrophysiology', 'electrophysiology'],
        ['The beating heart', 'heartbeat'],
      ]),
      part('Reference', 'reference', [
        ['Fields of a case', 'recipe'],
        ['The command line', 'command_line'],
        ['Formats and units', 'formats'],
        ['The package', 'package'],
      ]),
      part('Share and teach', 'share', [
        ['Share a case by link', 'links'],
        ['Lessons for teachers', 'lessons'],
        ['Studies of many cases', 'studies'],
        ['How to cite', 'cite'],
      ]),
      part('About', 'about', [
        ['Verification', 'verification'],
        ['Algorithms in short', 'algorithms'],
        ['Glossary', 'glossary'],
      ]),
    ],
  },
});
