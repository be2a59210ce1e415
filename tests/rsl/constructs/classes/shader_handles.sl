// shader handles and '->'
surface shader_handles(uniform shader layers[] = {}) { Ci = layers[0]->tint(P); }
