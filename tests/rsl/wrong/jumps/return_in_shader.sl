surface x() { Ci = 1; return; }
//! 1:23 warning RSL_SHADER_RETURN it ends the shader
