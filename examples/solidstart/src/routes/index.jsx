const alphas = [0.1, 0.05, 0.05, 0.1, 0.01, 0.01];

export default () => <banana-machine omega="0.8" samples={20000} alphas={alphas}></banana-machine>;
