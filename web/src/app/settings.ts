// What this browser keeps for whoever sits before it.

export type Theme = 'auto' | 'light' | 'dark';

export interface Settings {
  readonly theme: Theme;
  /** Who acts: every action on an alert says by whom. Empty until asked. */
  readonly operator: string;
}

export type SettingsAction = { type: 'settings/theme'; theme: Theme } | { type: 'settings/operator'; operator: string };

export function reduceSettings(settings: Settings, action: SettingsAction): Settings {
  return action.type === 'settings/theme'
    ? { ...settings, theme: action.theme }
    : { ...settings, operator: action.operator };
}

const kTheme = 'raywatch.theme'; // public/theme.js reads it, too
const kOperator = 'raywatch.operator';

export function loadSettings(): Settings {
  const theme = read(kTheme);
  return { theme: theme === 'light' || theme === 'dark' ? theme : 'auto', operator: read(kOperator) };
}

export function saveSettings(settings: Settings): void {
  try {
    localStorage.setItem(kTheme, settings.theme);
    localStorage.setItem(kOperator, settings.operator);
  } catch {
    // Without storage it holds until the page is left.
  }
}

function read(key: string): string {
  try {
    return localStorage.getItem(key) ?? '';
  } catch {
    return '';
  }
}
