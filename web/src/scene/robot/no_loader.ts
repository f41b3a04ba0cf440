/** Stands for the STL and Collada loaders that urdf-loader brings and nothing here calls: meshes
 * are read by meshes.ts. In a page that `mrlab show` writes it stands for the decoder of packed
 * files, too: such a page holds none, and may run no WebAssembly. */
export class STLLoader {}
export class ColladaLoader {}
export const MeshoptDecoder = null
