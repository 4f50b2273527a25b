import 'motion-widgets';
