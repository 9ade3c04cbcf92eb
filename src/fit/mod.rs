//! Floor 2: fitting Phong peaks to a distribution of normals.
