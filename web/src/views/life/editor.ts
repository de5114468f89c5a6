// The editor of a routine's text, in a shadow root: its styles are made by script, and the page's policy allows style
// sheets there, but no style elements.

import { type CompletionContext, type CompletionResult, autocompletion, insertCompletionText, pickedCompletion } from '@codemirror/autocomplete';
import { defaultKeymap, history, historyKeymap, isolateHistory } from '@codemirror/commands';
import { type Diagnostic, forEachDiagnostic, lintKeymap, setDiagnostics } from '@codemirror/lint';
import { Annotation, EditorState, type Extension, type Range, StateEffect, StateField, Text } from '@codemirror/state';
import { Decoration, type DecorationSet, EditorView, ViewPlugin, type ViewUpdate, highlightActiveLine, highlightActiveLineGutter, highlightSpecialChars, keymap, lineNumbers } from '@codemirror/view';
import { unitsAfter } from '../../places';
import type { Completion, ProblemView, TextEditView } from '../../wire';
import { replacements, offers } from './completions';
import { placeOf } from './marks';
import { look } from './look';
import { MOST_ROWS } from './rows';

/** Data that the editor requests when it needs them. */
type Host = {
  /** The possible words, and the names of the person. */
  words: () => readonly Completion[];
  names: () => string[];
  onwrite: (text: string) => void;
  /** Called when the cursor, the text or the visible part has changed. */
  onview: () => void;
};

/** Free space below the line of the cursor. */
const MARGIN_PX = 6;

/** Marks a change from outside, which the user did not type. */
const given = Annotation.define<boolean>();

export class RoutineEditor {
  private view: EditorView;
  /** Positions in the text that move with its changes. */
  private anchors: number[] = [];
  private height = 0;
  private readonly size: ResizeObserver;

  constructor(
    parent: HTMLElement,
    private readonly host: Host,
    private text: string,
    private label: string,
  ) {
    const root = parent.shadowRoot ?? parent.attachShadow({ mode: 'open' });
    root.replaceChildren();
    this.view = new EditorView({ state: this.state(text), parent: root as unknown as Element, root });
    this.view.scrollDOM.addEventListener('scroll', () => host.onview());
    this.size = new ResizeObserver(() => this.resized());
    this.size.observe(parent);
  }

  destroy(): void {
    this.size.disconnect();
    this.view.destroy();
  }

  focus(): void {
    this.view.focus();
  }

  /** Shows another text; if it is nearly the same, the cursor and the undo history stay. */
  show(text: string, label: string): void {
    if (label !== this.label || lineEnd(text) !== lineEnd(this.text)) {
      [this.text, this.label, this.anchors] = [text, label, []];
      this.view.setState(this.state(text));
      return;
    }
    if (text === this.text) return;
    const old = this.text;
    this.text = text;
    const changes = difference(this.view.state.toText(old), this.view.state.toText(text));
    this.view.dispatch({ changes, annotations: given.of(true) });
  }

  /** Underlines problems and warnings. */
  mark(problems: readonly ProblemView[], warnings: readonly ProblemView[]): void {
    const doc = this.view.state.doc;
    const marks = (all: readonly ProblemView[], severity: Diagnostic['severity']) =>
      all.flatMap((problem): Diagnostic[] => {
        const place = placeOf(problem, doc);
        if (place === null) return [];
        return [{ ...place, severity, message: problem.what, renderMessage: () => told(problem) }];
      });
    this.view.dispatch(setDiagnostics(this.view.state, [...marks(problems, 'error'), ...marks(warnings, 'warning')]));
  }

  /** Moves the cursor to a position, both counted from 1 and in characters, and shows it. */
  goTo(line: number, column: number): void {
    const { doc } = this.view.state;
    const at = Math.min(Math.max(line, 1), doc.lines);
    const place = placeOf({ file: '', line: at, column: Math.max(column, 1), width: 1, what: '', hint: null }, doc)!;
    const head = Math.min(place.from, doc.line(at).to);
    this.view.dispatch({ selection: { anchor: head }, effects: EditorView.scrollIntoView(head, { y: 'nearest', yMargin: 40 }) });
  }

  /** Changes the text as one step of the undo history, and goes to the end of the last change. */
  write(edits: readonly TextEditView[]): void {
    const { doc } = this.view.state;
    const at = (line: number, column: number) => {
      const of = doc.line(Math.min(Math.max(line, 1), doc.lines));
      return of.from + unitsAfter(of.text, column - 1);
    };
    const changes = this.view.state.changes(edits.map((edit) => ({ from: at(edit.line, edit.column), to: at(edit.to_line, edit.to_column), insert: Text.of(edit.insert.split('\n')) })));
    let head = 0;
    changes.iterChanges((_, __, ___, end) => (head = end));
    this.view.dispatch({ changes, selection: { anchor: head }, effects: EditorView.scrollIntoView(head, { y: 'nearest', yMargin: 40 }), annotations: isolateHistory.of('full'), userEvent: 'input' });
  }

  /** Follows these lines from now on, wherever they move. */
  follow(lines: readonly number[]): void {
    const { doc } = this.view.state;
    this.anchors = lines.map((line) => doc.line(Math.min(Math.max(line, 1), doc.lines)).from);
    // A line with several interpretations is as high as they are.
    const rows = new Map<number, number>();
    for (const at of this.anchors) rows.set(at, (rows.get(at) ?? 0) + 1);
    const high = [...rows].filter(([, count]) => count > 1).sort(([a], [b]) => a - b);
    this.view.dispatch({ effects: setRows.of(Decoration.set(high.map(([at, count]) => Decoration.line({ class: `rows-${Math.min(count, MOST_ROWS)}` }).range(at)))) });
  }

  /** The followed lines: their distance from the top of the text, in pixels, and their present numbers. */
  followed(): { top: number; line: number }[] {
    const { doc } = this.view.state;
    return this.anchors.map((at) => {
      const place = Math.min(at, doc.length);
      return { top: this.view.lineBlockAt(place).top + this.view.documentPadding.top, line: doc.lineAt(place).number };
    });
  }

  get line(): number {
    return this.cursor.line;
  }

  /** The place of the cursor, from 1, in characters. */
  get cursor(): { line: number; column: number } {
    const { doc, selection } = this.view.state;
    const { number, from, text } = doc.lineAt(selection.main.head);
    return { line: number, column: [...text.slice(0, selection.main.head - from)].length + 1 };
  }

  get scroll(): { top: number; height: number } {
    return { top: this.view.scrollDOM.scrollTop, height: this.view.scrollDOM.scrollHeight };
  }

  scrollTo(top: number): void {
    if (Math.abs(this.view.scrollDOM.scrollTop - top) >= 1) this.view.scrollDOM.scrollTop = top;
  }

  /** Problems that appear below while the user types do not hide the line of the cursor. */
  private resized(): void {
    const { scrollDOM, state, documentPadding } = this.view;
    const before = this.height;
    this.height = scrollDOM.clientHeight;
    const bottom = this.view.lineBlockAt(state.selection.main.head).bottom + documentPadding.top;
    if (!this.view.hasFocus || bottom > scrollDOM.scrollTop + before) return;
    this.scrollTo(Math.max(scrollDOM.scrollTop, bottom - this.height + MARGIN_PX));
  }

  private state(text: string): EditorState {
    return EditorState.create({ doc: this.split(text), extensions: this.extensions(text) });
  }

  private split(text: string): Text {
    return EditorState.create({ extensions: EditorState.lineSeparator.of(lineEnd(text)) }).toText(text);
  }

  private extensions(text: string): Extension {
    return [
      // A file keeps its line ends.
      EditorState.lineSeparator.of(lineEnd(text)),
      lineNumbers(),
      highlightActiveLine(),
      highlightActiveLineGutter(),
      highlightSpecialChars(),
      history(),
      EditorView.lineWrapping,
      EditorView.contentAttributes.of({ 'aria-label': this.label, spellcheck: 'false', tabindex: '0' }),
      // Nothing is selected until the user moves down, so that Enter at the end of a sentence begins a line; a quick
      // move down is intentional.
      autocompletion({ override: [(context) => this.complete(context)], selectOnOpen: false, icons: false, activateOnTypingDelay: 60, interactionDelay: 0 }),
      keymap.of([...defaultKeymap, ...historyKeymap, ...lintKeymap]),
      comments,
      rowsOf,
      look,
      EditorView.updateListener.of((update) => this.changed(update)),
    ];
  }

  private changed(update: ViewUpdate): void {
    if (update.docChanged) {
      this.anchors = this.anchors.map((at) => update.changes.mapPos(at, 1));
      if (!update.transactions.some((transaction) => transaction.annotation(given) === true)) {
        this.text = update.state.sliceDoc();
        this.host.onwrite(this.text);
      }
    }
    if (update.docChanged || update.selectionSet || update.geometryChanged) this.host.onview();
  }

  private complete({ state, pos, explicit }: CompletionContext): CompletionResult | null {
    const line = state.doc.lineAt(pos);
    const before = line.text.slice(0, pos - line.from);
    const found = offers(before, this.host.words(), this.host.names(), explicit);
    const options = found.map(({ word, from }) => option(word, line.from + from, pos));
    const wrong = explicit ? this.underlined(state, pos) : null;
    if (wrong !== null && (pos < wrong.to || options.length === 0)) {
      const words = replacements(state.sliceDoc(wrong.from, wrong.to), line.text.slice(0, wrong.from - line.from), this.host.words(), this.host.names());
      if (words.length > 0) return { from: pos, options: words.map((word) => option(word, wrong.from, wrong.to)), filter: false };
    }
    return options.length === 0 ? null : { from: pos, options, filter: false };
  }

  /** Unknown words at a position. */
  private underlined(state: EditorState, pos: number): { from: number; to: number } | null {
    let found: { from: number; to: number } | null = null;
    forEachDiagnostic(state, ({ severity }, from, to) => {
      if (severity === 'error' && from <= pos && pos <= to && to <= state.doc.lineAt(pos).to) found ??= { from, to };
    });
    return found;
  }
}

function option(word: Completion, from: number, to: number) {
  return {
    label: word.text,
    detail: word.about,
    apply: (view: EditorView, completion: Parameters<typeof pickedCompletion.of>[0], _: number, end: number) =>
      view.dispatch({ ...insertCompletionText(view.state, word.text, from, Math.max(end, to)), annotations: pickedCompletion.of(completion) }),
  };
}

/** A problem with its fix. */
function told(problem: ProblemView): Node {
  const both = document.createElement('div');
  for (const text of [problem.what, problem.hint]) {
    if (text === null) continue;
    const part = document.createElement('p');
    part.dir = 'auto';
    part.textContent = text.slice(0, 2000);
    both.append(part);
  }
  return both;
}

/** The line end of a text, if all lines share it. */
function lineEnd(text: string): string {
  const ends = text.split('\n').length - 1;
  return ends > 0 && text.split('\r\n').length - 1 === ends ? '\r\n' : '\n';
}

/** The smallest change that turns one text into the other. */
function difference(old: Text, fresh: Text): { from: number; to: number; insert: Text } {
  const [a, b] = [old.toString(), fresh.toString()];
  let from = 0;
  while (from < a.length && from < b.length && a[from] === b[from]) from += 1;
  let [to, end] = [a.length, b.length];
  while (to > from && end > from && a[to - 1] === b[end - 1]) [to, end] = [to - 1, end - 1];
  return { from, to, insert: fresh.slice(from, end) };
}

const setRows = StateEffect.define<DecorationSet>();

/** Lines that are as high as several rows next to them. */
const rowsOf = StateField.define<DecorationSet>({
  create: () => Decoration.none,
  update(rows, { changes, effects }) {
    return effects.reduce((all, effect) => (effect.is(setRows) ? effect.value : all), rows.map(changes));
  },
  provide: (field) => EditorView.decorations.from(field),
});

const comment = Decoration.mark({ class: 'comment' });

/** Text after # is a comment, and drawn as one. */
const comments = ViewPlugin.fromClass(
  class {
    decorations: DecorationSet;
    constructor(view: EditorView) {
      this.decorations = found(view);
    }
    update(update: ViewUpdate) {
      if (update.docChanged || update.viewportChanged) this.decorations = found(update.view);
    }
  },
  { decorations: (plugin) => plugin.decorations },
);

function found(view: EditorView): DecorationSet {
  const marks: Range<Decoration>[] = [];
  for (const { from, to } of view.visibleRanges) {
    for (let at = from; at <= to; ) {
      const line = view.state.doc.lineAt(at);
      const sign = line.text.indexOf('#');
      if (sign !== -1) marks.push(comment.range(line.from + sign, line.to));
      at = line.to + 1;
    }
  }
  return Decoration.set(marks);
}
