import 'motion-widgets';
import './index.html';
