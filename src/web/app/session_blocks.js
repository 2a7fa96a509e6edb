// Reads the session blocks of documents: prompts, inputs and what they show.

// The place after the form that begins at `at`, or -1 if it does not end.
function formEnd(text, at) {
  let depth = 0;
  for (let i = at; i < text.length; i += 1) {
    const c = text[i];
    if (c === '"') {
      for (i += 1; i < text.length && text[i] !== '"'; i += 1) if (text[i] === '\\') i += 1;
    } else if (c === ';') {
      while (i < text.length && text[i] !== '\n') i += 1;
    } else if (c === '|') {
      i = text.indexOf('|', i + 1);
      if (i < 0) return -1;
    } else if (c === '#' && text[i + 1] === '\\') i += 2;
    else if (c === '(') depth += 1;
    else if (c === ')') depth -= 1;
    else if (c === '\n' && depth === 0) return i;
    if (depth < 0) return -1;
  }
  return depth === 0 ? text.length : -1;
}

const PROMPT = /^([A-Z][A-Z0-9\-+*/.:_%&=?!]*(?: (?:stopped|\d+\])(?: \w+)?)?>) ?/;

// The inputs of a block, each with its prompt and what it shows.
export function inputsOf(block) {
  const inputs = [];
  let rest = block;
  while (rest) {
    const prompt = PROMPT.exec(rest);
    if (!prompt) {
      const [line] = rest.split('\n', 1);
      if (inputs.length) inputs.at(-1).shown += `${line}\n`;
      rest = rest.slice(line.length + 1);
      continue;
    }
    const text = rest.slice(prompt[0].length);
    const end = formEnd(text, 0);
    const input = end < 0 ? text.split('\n', 1)[0] : text.slice(0, end);
    inputs.push({ prompt: prompt[1], text: input.trim(), shown: '' });
    rest = text.slice(input.length + 1);
  }
  for (const input of inputs) input.shown = input.shown.trimEnd();
  return inputs;
}
