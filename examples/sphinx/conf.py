project = 'Motion models'
author = 'The author'
copyright = '2026, The author'
html_title = 'Motion models'

exclude_patterns = ['_build']

html_theme = 'furo'
html_static_path = ['_static']
html_css_files = ['motion-widgets.css']
html_js_files = [('motion-widgets.iife.js', {'defer': 'defer'})]
