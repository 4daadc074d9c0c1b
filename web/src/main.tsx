import { render } from 'preact';
import './styles/tokens.css';
import './styles/base.css';
import './styles/components.css';
import { startApp } from './app/app';
import { Shell } from './app/shell';

const root = document.getElementById('app');
if (root) {
  startApp();
  render(<Shell />, root);
}
