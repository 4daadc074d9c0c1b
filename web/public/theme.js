// Before anything is painted, so that a dark room stays dark. The chosen theme is kept by src/app/settings.ts.
try {
  const theme = localStorage.getItem('raywatch.theme');
  if (theme === 'light' || theme === 'dark') document.documentElement.dataset.theme = theme;
} catch {
  // Without storage the system's preference holds.
}
