import { index, route } from '@react-router/dev/routes';

export default [index('motion.jsx'), route('sensors', 'sensors.jsx')];
