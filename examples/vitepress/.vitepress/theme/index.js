import DefaultTheme from 'vitepress/theme'
import 'motion-widgets'
import 'motion-widgets/motion-widgets.css'

export default DefaultTheme
