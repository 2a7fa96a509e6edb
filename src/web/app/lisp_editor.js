// Editors for plans: highlighting, matching parentheses, indentation, completion.

import { autocompletion, completionKeymap, startCompletion, acceptCompletion } from '@codemirror/autocomplete';
import { defaultKeymap, history, historyKeymap, indentLess, indentMore } from '@codemirror/commands';
import { HighlightStyle, StreamLanguage, bracketMatching, indentOnInput, syntaxHighlighting } from '@codemirror/language';
import { commonLisp } from '@codemirror/legacy-modes/mode/commonlisp';
import { EditorState, Prec } from '@codemirror/state';
import { EditorView, drawSelection, keymap, lineNumbers } from '@codemirror/view';
import { tags } from '@lezer/highlight';

const lisp = StreamLanguage.define(commonLisp);

// The colours are variables of the page's style.
const colors = HighlightStyle.define([
  { tag: tags.comment, color: 'var(--comment)' },
  { tag: tags.string, color: 'var(--string)' },
  { tag: tags.number, color: 'var(--number)' },
  { tag: tags.keyword, color: 'var(--keyword)' },
  { tag: tags.atom, color: 'var(--atom)' },
]);

const look = EditorView.theme({
  '&': { backgroundColor: 'transparent', color: 'inherit', fontSize: 'inherit' },
  '.cm-content': { caretColor: 'var(--ink)', fontFamily: 'var(--mono)', padding: '4px 0' },
  '.cm-cursor': { borderLeftColor: 'var(--ink)' },
  '&.cm-focused': { outline: 'none' },
  '.cm-gutters': { backgroundColor: 'transparent', color: 'var(--faint)', border: 'none' },
  '&.cm-focused .cm-matchingBracket': { backgroundColor: 'var(--match)', outline: '1px solid var(--accent)' },
  '&.cm-focused .cm-nonmatchingBracket': { backgroundColor: 'var(--mismatch)' },
  '.cm-tooltip': { backgroundColor: 'var(--paper)', color: 'var(--ink)', border: '1px solid var(--line)' },
  '.cm-tooltip.cm-tooltip-autocomplete > ul > li[aria-selected]': { backgroundColor: 'var(--accent)', color: 'var(--paper)' },
  '.cm-completionInfo': { maxWidth: '340px', fontSize: '12px' },
});

// Completions of the session at the cursor.
const completing = (engine) => async ({ state, pos, explicit }) => {
  const text = state.doc.toString();
  if (!explicit && !/[\w:?*+-]{2}$/.test(text.slice(0, pos))) return null;
  const { completions, start } = await engine.ask('complete', { text, at: pos });
  if (!completions?.length) return null;
  return {
    from: start,
    options: completions.map(([label, info]) => ({ label, info: info || undefined })),
    filter: false,
  };
};

// With only blanks before the cursor, Tab indents; otherwise it completes.
const tab = (view) => {
  const { head } = view.state.selection.main;
  const line = view.state.doc.lineAt(head);
  if (!view.state.sliceDoc(line.from, head).trim()) return indentMore(view);
  return startCompletion(view);
};

export function makeEditor({ parent, engine, label, keys = [], text = '', hasLines = false, onChange = () => {} }) {
  const view = new EditorView({
    parent,
    state: EditorState.create({
      doc: text,
      extensions: [
        Prec.highest(keymap.of(keys)),
        Prec.high(keymap.of([{ key: 'Tab', run: (at) => acceptCompletion(at) || tab(at), shift: indentLess }])),
        keymap.of([...completionKeymap, ...historyKeymap, ...defaultKeymap]),
        history(),
        lisp,
        drawSelection(),
        hasLines ? lineNumbers() : [],
        indentOnInput(),
        bracketMatching({ maxScanDistance: 100000 }),
        syntaxHighlighting(colors),
        autocompletion({ override: [completing(engine)], activateOnTyping: true, defaultKeymap: false, icons: false }),
        EditorView.lineWrapping,
        EditorView.contentAttributes.of({ 'aria-label': label, spellcheck: 'false', autocorrect: 'off', autocapitalize: 'off' }),
        EditorView.updateListener.of((update) => { if (update.docChanged || update.selectionSet) onChange(update); }),
        look,
      ],
    }),
  });
  return view;
}

export const textOf = (view) => view.state.doc.toString();

export function setText(view, text) {
  view.dispatch({ changes: { from: 0, to: view.state.doc.length, insert: text }, selection: { anchor: text.length } });
}
