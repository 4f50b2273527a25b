import { A, Router } from '@solidjs/router';
import { FileRoutes } from '@solidjs/start/router';
import { Suspense } from 'solid-js';
import 'motion-widgets';
import 'motion-widgets/motion-widgets.css';

const Layout = (props) => (
  <>
    <nav><A href="/">Motion</A> <A href="/sensors">Sensors</A></nav>
    <Suspense>{props.children}</Suspense>
  </>
);

export default () => <Router root={Layout}><FileRoutes /></Router>;
