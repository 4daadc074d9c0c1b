/** The key that does the same as the button beside it; nothing on devices without a keyboard. */
export function KeyHint({ keys }: { keys: string }) {
  return (
    <kbd class="key" aria-hidden="true">
      {keys}
    </kbd>
  );
}
