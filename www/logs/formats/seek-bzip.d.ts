declare module '@openpgp/seek-bzip' {
  const bzip: { decode(bytes: Uint8Array, out: Uint8Array): Uint8Array };
  export default bzip;
}
