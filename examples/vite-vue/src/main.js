import { createApp } from 'vue'
import 'motion-widgets'
import 'motion-widgets/motion-widgets.css'
import './style.css'
import App from './App.vue'

createApp(App).mount('#app')
