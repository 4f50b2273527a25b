import { mount } from 'svelte'
import 'motion-widgets'
import 'motion-widgets/motion-widgets.css'
import './style.css'
import App from './App.svelte'

export default mount(App, { target: document.getElementById('app') })
