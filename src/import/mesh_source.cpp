// Triangle meshes as field sources.
