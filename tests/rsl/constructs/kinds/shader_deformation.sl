// deformation: the other name of transformation shaders
deformation shader_deformation(float by = 0.1) { P += by * N; }
