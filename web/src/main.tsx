import { render } from 'preact';
import './styles/tokens.css';
import './styles/base.css';
import './styles/shell.css';
import './styles/components.css';
import './styles/dialogs.css';
import './styles/forms.css';
import { startApp } from './app/app';
import { Shell } from './app/shell';

const root = document.getElementById('app');
if (root) {
  startApp();
  render(<Shell />, root);
}
