import { Link, Links, Meta, Outlet, Scripts } from 'react-router';
import 'motion-widgets/motion-widgets.css';

export default function Root() {
  return (
    <html lang="en">
      <head>
        <meta charSet="utf-8" />
        <link rel="icon" href="data:," />
        <Meta />
        <Links />
      </head>
      <body>
        <nav><Link to="/">Motion</Link> <Link to="/sensors">Sensors</Link></nav>
        <Outlet />
        <Scripts />
      </body>
    </html>
  );
}
