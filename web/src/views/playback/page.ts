// A page made by a command, shown in a shadow root, so that neither style affects the other.

/** Additions: it scrolls as a whole if it is wide, and is dark on light, as the command draws it. */
const WITHIN = `body{display:block;margin:0;max-width:none;min-width:44rem;padding:0.8rem;background:#fff;color-scheme:light}
  h1{margin:0;font-size:1.2rem}h2{font-size:1.05rem}figure{margin:1rem 0}`;

export function showPage(host: HTMLElement, html: string): void {
  const root = host.shadowRoot ?? host.attachShadow({ mode: 'open' });
  // The policy of the page forbids style elements, and allows styles set by script.
  const styles: string[] = [];
  const plain = html.replace(/<style>([^<]*)<\/style>/g, (_, style: string) => {
    styles.push(style);
    return '';
  });
  const sheet = new CSSStyleSheet();
  sheet.replaceSync(styles.join('\n') + WITHIN);
  root.adoptedStyleSheets = [sheet];
  const page = new DOMParser().parseFromString(plain, 'text/html');
  for (const element of page.querySelectorAll('style, script, iframe, object, embed, link, meta')) element.remove();
  root.replaceChildren(root.ownerDocument.adoptNode(page.body));
}
