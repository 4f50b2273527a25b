import 'motion-widgets';
import 'motion-widgets/motion-widgets.css';
