// @ts-check
import { defineConfig } from 'astro/config';
import starlight from '@astrojs/starlight';

// https://astro.build/config
export default defineConfig({
	base: '/book',
	integrations: [
		starlight({
			title: 'Probable Motion',
			sidebar: ['motion', 'sensors'],
			customCss: ['motion-widgets/motion-widgets.css'],
			components: { Head: './src/Head.astro' },
		}),
	],
});
