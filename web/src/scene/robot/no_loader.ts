/** Stands for the STL and Collada loaders that urdf-loader brings and nothing here calls: meshes
 * are read by meshes.ts. */
export class STLLoader {}
export class ColladaLoader {}
