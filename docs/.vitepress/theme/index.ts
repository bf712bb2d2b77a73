import { onMounted, h } from 'vue';
import Theme from 'vitepress/theme';
import './style.css';

/** Pages were written with addresses relative to them; what stays when another page comes must not be. */
function pinLinks() {
  for (const link of document.querySelectorAll<HTMLAnchorElement>('a[href], link[rel="icon"]'))
    link.setAttribute('href', link.href);
}

export default {
  extends: Theme,
  Layout: {
    setup() {
      onMounted(pinLinks);
      return () => h(Theme.Layout);
    },
  },
};
