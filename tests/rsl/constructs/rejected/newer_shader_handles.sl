// shader handles and '->'
surface newer_shader_handles(uniform shader layers[] = {}) { Ci = layers[0]->tint(P); }
