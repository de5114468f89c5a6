// The style of the editor: that of the page, whose colours reach into the shadow root.

import { EditorView } from '@codemirror/view';
import { LINE_PX, MOST_ROWS } from './rows';

export const look = EditorView.theme({
  '&': { height: '100%', backgroundColor: 'var(--raised)', color: 'var(--text)', fontSize: '14px' },
  '&.cm-focused': { outline: 'none' },
  '.cm-scroller': { fontFamily: 'inherit', lineHeight: `${LINE_PX}px`, overflow: 'auto' },
  '.cm-content': { padding: '8px 0 96px', caretColor: 'var(--text)' },
  '.cm-line': { padding: '0 8px 0 6px' },
  ...Object.fromEntries(Array.from({ length: MOST_ROWS - 1 }, (_, index) => [`.rows-${index + 2}`, { minHeight: `${(index + 2) * LINE_PX}px` }])),
  '.cm-cursor': { borderLeftColor: 'var(--text)' },
  '.cm-gutters': { backgroundColor: 'var(--raised)', color: 'var(--quiet)', border: 'none', fontSize: '12px', fontVariantNumeric: 'tabular-nums' },
  '.cm-lineNumbers .cm-gutterElement': { minWidth: '30px', padding: '0 6px 0 4px' },
  '.cm-activeLine, .cm-activeLineGutter': { backgroundColor: 'var(--accent-soft)', color: 'inherit' },
  '.comment': { color: 'var(--quiet)', fontStyle: 'italic' },
  '.cm-lintRange-error, .cm-lintRange-warning': { backgroundImage: 'none', textDecorationLine: 'underline', textDecorationThickness: '2px', textUnderlineOffset: '4px', textDecorationSkipInk: 'none' },
  '.cm-lintRange-error': { textDecorationStyle: 'wavy', textDecorationColor: 'var(--bad)' },
  '.cm-lintRange-warning': { textDecorationStyle: 'dotted', textDecorationColor: 'var(--accent)' },
  '.cm-lintRange-active': { backgroundColor: 'var(--bad-soft)' },
  '.cm-lintPoint::after': { borderBottomColor: 'var(--bad)' },
  '.cm-tooltip': { maxWidth: '560px', border: '1px solid var(--edge)', borderRadius: '8px', backgroundColor: 'var(--raised)', color: 'var(--text)', boxShadow: 'var(--shadow)', overflow: 'hidden' },
  '.cm-diagnostic': { padding: '6px 10px', overflowWrap: 'anywhere' },
  '.cm-diagnostic-error': { borderLeft: '4px solid var(--bad)' },
  '.cm-diagnostic-warning': { borderLeft: '4px solid var(--accent)' },
  '.cm-diagnostic p': { margin: '0' },
  '.cm-diagnostic p + p': { marginTop: '4px', color: 'var(--quiet)' },
  '.cm-tooltip.cm-tooltip-autocomplete > ul': { maxHeight: '260px', fontFamily: 'inherit' },
  '.cm-tooltip.cm-tooltip-autocomplete > ul > li': { minHeight: '26px', padding: '2px 10px', lineHeight: '22px', display: 'flex', gap: '12px' },
  '.cm-tooltip.cm-tooltip-autocomplete > ul > li[aria-selected]': { backgroundColor: 'var(--accent)', color: 'var(--accent-text)' },
  '.cm-completionLabel': { overflow: 'hidden', textOverflow: 'ellipsis', whiteSpace: 'nowrap' },
  '.cm-completionDetail': { flex: '1 0 auto', marginLeft: '0', textAlign: 'right', fontStyle: 'normal', color: 'var(--quiet)' },
  'li[aria-selected] .cm-completionDetail': { color: 'inherit' },
});
