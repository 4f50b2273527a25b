import 'motion-widgets/external';
