import type { Metadata } from 'next';
import Link from 'next/link';
import 'motion-widgets/motion-widgets.css';
import './globals.css';

export const metadata: Metadata = {
  title: 'Probable Motion',
};

export default function RootLayout({ children }: LayoutProps<'/'>) {
  return (
    <html lang="en">
      <body>
        <nav>
          <Link href="/">Motion</Link> <Link href="/sensors">Sensors</Link>
        </nav>
        {children}
      </body>
    </html>
  );
}
