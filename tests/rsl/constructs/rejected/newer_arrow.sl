// '->'
surface newer_arrow() { float a = s; Ci = a->b; Ci = undefined; }
