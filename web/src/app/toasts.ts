// Short messages that go by themselves: what was done, or why it was not.

export interface Toast {
  readonly id: number;
  readonly tone: 'good' | 'bad' | 'note';
  readonly text: string;
}

export type ToastAction = { type: 'toast/shown'; toast: Toast } | { type: 'toast/closed'; id: number };

export function reduceToasts(toasts: readonly Toast[], action: ToastAction): readonly Toast[] {
  if (action.type === 'toast/shown') return [...toasts, action.toast].slice(-4);
  return toasts.filter((toast) => toast.id !== action.id);
}
