import { BananaMachine } from 'motion-widgets/react';

export default () => <BananaMachine omega="0.8" samples={20000} alphas={[0.1, 0.05, 0.05, 0.1, 0.01, 0.01]} />;
