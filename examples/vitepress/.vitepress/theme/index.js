import DefaultTheme from 'vitepress/theme'
import 'motion-widgets'

export default DefaultTheme
