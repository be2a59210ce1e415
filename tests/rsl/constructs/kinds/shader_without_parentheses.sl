// a shader without parameters and parentheses
surface shader_without_parentheses { Ci = Cs * Os; Oi = Os; }
