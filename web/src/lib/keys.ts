// The keyboard: a view says which keys it understands, and the help shows exactly those.

export interface KeyBinding {
  /** As `KeyboardEvent.key`: "j", "Enter", "?". */
  readonly key: string;
  readonly does: string;
  readonly run: () => void;
}

type Layer = () => readonly KeyBinding[];

const layers: Layer[] = [];

/** Adds a view's keys on top of those that are there. @returns what takes them away. */
export function addKeys(layer: Layer): () => void {
  layers.push(layer);
  return () => {
    const index = layers.lastIndexOf(layer);
    if (index >= 0) layers.splice(index, 1);
  };
}

/** The keys that work now; of two views the upper one's. */
export function currentKeys(): KeyBinding[] {
  const byKey = new Map<string, KeyBinding>();
  for (const layer of layers) for (const binding of layer()) byKey.set(binding.key, binding);
  return [...byKey.values()];
}

const kTyping = 'input:not([type=checkbox]):not([type=radio]), textarea, select, [contenteditable]';

/** Whether a key press is for the view: not while something is typed or a dialog asks, and not with modifiers. */
function isForView(event: KeyboardEvent): boolean {
  if (event.defaultPrevented || event.ctrlKey || event.metaKey || event.altKey) return false;
  const target = event.target as Element | null;
  if (target?.closest(kTyping) || document.querySelector('dialog[open]')) return false;
  // Enter and blank belong to the button or link that has the focus.
  const presses = event.key === 'Enter' || event.key === ' ';
  return !(presses && target?.closest('a, button, summary, input'));
}

export function listenToKeys(): () => void {
  const listener = (event: KeyboardEvent): void => {
    if (!isForView(event)) return;
    const binding = currentKeys().find((candidate) => candidate.key === event.key);
    if (!binding) return;
    event.preventDefault();
    binding.run();
  };
  document.addEventListener('keydown', listener);
  return () => document.removeEventListener('keydown', listener);
}
