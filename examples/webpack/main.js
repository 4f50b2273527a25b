import 'motion-widgets/external';
import './index.html';
