"""tests/programs/shade/rsl2_test.py: what is known of RSL 2.0 from documents and public shaders, a row each: the fact, a
shader, the points it runs over, and the numbers that follow from the fact."""
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from points_test import Points
from programs import main

CASES = []


def C(clause, source, document=None, want=None, co=(), code=0, said=""):
    CASES.append((clause, source, document or {}, want or {}, dict(co), code, said))


S="public void surface(output color Ci, Oi)"
C("one class a file, class ID {", "class x { %s { Ci = 2; } }"%S, want={"Ci":[[2]*3]})
C("class ; behind", "class x() { %s { Ci = 2; } };"%S, want={"Ci":[[2]*3]})
C("parameters need no extern", "class x(float k=3;) { float f() { return k; } %s { Ci = f(); } }"%S, want={"Ci":[[3]*3]})
C("shader x=null, a[]={}, a[4], a[]=null","class x(shader a=null; shader b[]={}; shader c[4]={null,null,null,null}; shader d[]=null;) { %s { Ci = color(arraylength(b), arraylength(c), arraylength(d)); } }"%S, want={"Ci":[[0,4,0]]})
C("initialisers use parameters, earlier members, built-ins before construct()","class x(float k=3;) { float a = k*2; float b = a+sqrt(4); float c=0; public void construct() { c = b; } %s { Ci = c; } }"%S, want={"Ci":[[8]*3]})
C("member without detail: varying if assigned varying","class x() { float m=0; public void begin() { m = s; } %s { Ci = m; } }"%S, {"variables":{"s":[1,2]}}, {"Ci":[[1]*3,[2]*3]})
C("struct local to class","class x() { struct A { float k=4; } A a; %s { Ci = a->k; } }"%S, want={"Ci":[[4]*3]})
C("struct local to function","class x() { %s { struct A { float k=4; float twice() { return 2*k; } } A a; Ci = a->twice(); } }"%S, want={"Ci":[[8]*3]})
C("struct redefined identically","struct A { float k=1; } struct A { float k=1; } class x() { A a; %s { Ci = a->k; } }"%S, want={"Ci":[[1]*3]})
C("uniform S x","struct A { float k=1; } class x() { uniform A a; %s { Ci = a->k; } }"%S, want={"Ci":[[1]*3]})
C("varying filterregion f","class x() { varying filterregion f; %s { f->calculate2d(s,t); Ci = f->ss; } }"%S, {"variables":{"s":[3,4]}}, want={"Ci":[[3]*3,[4]*3]})
C("methods overload","struct A { float f(float x) { return 1; } float f(color c) { return 2; } float f(float x; float y) { return 3; } } class x() { A a; %s { Ci = color(a->f(1), a->f(Cs), a->f(1,1)); } }"%S, want={"Ci":[[1,2,3]]})
C("inheritance","struct B { float k=1; float f() { return k; } float g() { return 10*f(); } } struct A : B { float m=5; float f() { return m; } float h() { return B::f() + B::g(); } } class x() { A a; %s { Ci = color(a->k, a->g(), a->h()); } }"%S, want={"Ci":[[1,50,51]]})
C("inheritance of three","struct A { float a() { return 1; } float z() { return 7; } } struct B : A { float a() { return 2; } } struct D : B { float b() { return B::a() + 10*A::a() + 100*A::z(); } } class x() { D d; %s { Ci = color(d->a(), d->b(), d->z()); } }"%S, want={"Ci":[[2,712,7]]})
C("a->b->f(), a[i]->f(x), a->b += x","struct T { float k=1; void add(float x) { k += x; } } struct A { T t; } class x() { A a; T b[3]; %s { a->t->add(2); a->t->k += 3; b[1]->add(4); Ci = color(a->t->k, b[1]->k, b[0]->k); } }"%S, want={"Ci":[[6,5,1]]})
C("x->d.n is (x->d) . n","struct A { vector d = vector(1,2,3); } class x() { A a; %s { normal n = normal(1,1,1); Ci = a->d.n; } }"%S, want={"Ci":[[6]*3]})
C("this, surface","class x() { public float g() { return 2; } %s { Ci = this->g() + surface->g() + (this == surface); } }"%S, want={"Ci":[[5]*3]})
C("variables and functions apart","class x() { float pdf(float q) { return q+1; } %s { float pdf[2]; pdf[1] = pdf(4); Ci = pdf[1]; } }"%S, want={"Ci":[[5]*3]})
C("overload by result","float f() { return 1; } vector f() { return vector(2,3,4); } class x() { %s { float a = f(); vector b = f(); Ci = color(a, b[0], b[2]); } }"%S, want={"Ci":[[1,2,4]]})
C("pipeline formals alias globals","void mv() { extern point P; extern normal N; P += 5*N; } class x() { public void displacement(output point P; output normal N) { mv(); } }",{"variables":{"N":[0,0,1]}}, want={"P":[[0,0,5]]})
C("elsewhere a formal P hides","float f(point P) { return P[0]; } class x() { %s { Ci = f(point(9,0,0)); } }"%S, want={"Ci":[[9]*3]})
C("extern only for enclosing function's locals","class x() { %s { float a = 1; float g() { a += 1; return a; } Ci = g(); } }"%S, want={"Ci":[[2]*3]})
C("&& || short circuit","class x() { float n=0; float f() { n += 1; return 1; } %s { if (s > 0 && f() > 0) Ci = 1; if (s > 0 || f() > 0) n += 10; Ci = n; } }"%S, {"variables":{"s":[0,1]}}, want={"Ci":[[11]*3,[11]*3]})
C("varying loop counters index arrays","class x() { %s { float a[4] = {1,2,3,4}; varying float i; float sum = 0; for (i = 0; i < s; i += 1) sum += a[i]; Ci = sum; } }"%S, {"variables":{"s":[2,4]}}, want={"Ci":[[3]*3,[10]*3]})
C("uncalled functions parsed, not checked","void never() { foo = bar(baz); } class x() { %s { Ci = 1; } }"%S, want={"Ci":[[1]*3]})
C("arrays: index floors, whole =","class x() { %s { float a[2] = {1,2}, b[2]; b = a; Ci = b[1.7]; } }"%S, want={"Ci":[[2]*3]})
C("arrays ==","class x() { %s { float a[2] = {1,2}, b[2]; b = a; Ci = a == b ? 1 : 0; } }"%S, want={"Ci":[[1]*3]})
C("arrays != resizable","class x() { %s { float a[] = {1,2}, b[]; push(b, 1); float eq = a == b; push(b, 2); Ci = color(eq, a == b, a != b); } }"%S, want={"Ci":[[0,1,0]]})
C("a[n], n not constant","class x(float n=3;) { %s { float a[n]; Ci = arraylength(a); } }"%S, want={"Ci":[[3]*3]})
C("a[n], n varying: maximum","class x() { %s { float a[s]; Ci = arraylength(a); } }"%S, {"variables":{"s":[2,5]}})
C("T a[] = 0: empty","class x(color a[] = 0;) { %s { push(a, color 3); Ci = arraylength(a) + a[0]; } }"%S, want={"Ci":[[4]*3]})
C("array parameter = {1,2}","class x(float a[] = {1,2};) { %s { Ci = a[1] + arraylength(a); } }"%S, want={"Ci":[[4]*3]})
C("casts color 1, (0,0,1)","class x() { %s { vector v = (0,0,1); Ci = color 1 + color v; } }"%S, want={"Ci":[[1,1,2]]})
C("methods: output color Ci; output color Oi; with last ;","class x() { public void surface(output color Ci; output color Oi;) { Ci = 2; } }", want={"Ci":[[2]*3]})
C("method: varying formals","class x() { public void surface(output varying color Ci, Oi) { Ci = 2; } }", want={"Ci":[[2]*3]})
C("construct without public; fewer formals","class x() { float k=0; void construct() { k=4; } public void surface(output color Ci) { Ci = k; } }", want={"Ci":[[4]*3]})
C("begin: attributes, rayinfo","class x() { uniform float d=9; varying float e=0; public void begin() { rayinfo(\"depth\", d); attribute(\"user:e\", e); } %s { Ci = d+e; } }"%S, {"attributes":{"user:e":3}}, want={"Ci":[[3]*3]})
C("volume(Ci, Oi) compiles","class x() { public void volume(output color Ci, Oi) { Ci *= 0.5; } }", code=2)
C("Ci enters specularlighting as the diffuse result","class x() { public void diffuselighting(output color Ci, Oi, Ii) { Ci = 2; Ii = 1; } public void specularlighting(output color Ci, Oi) { Ci = 3*Ci; } public void postlighting(output color Ci, Oi) { Ci += 1; } }", want={"Ci":[[7]*3]})
C("pipeline order","class x() { float n=0; void c(float k) { n = 10*n + k; } public void begin() { c(1); } public void displacement(output point P; output normal N) { c(2); } public void opacity(output color Oi) { c(3); } public void prelighting(output color Ci, Oi) { c(4); } public void lighting(output color Ci, Oi) { c(5); } public void postlighting(output color Ci, Oi) { c(6); Ci = n; } }", want={"Ci":[[123456]*3]})
C("Oi starts as Os, Ci as 0","class x() { %s { Ci += Oi; } }"%S, {"variables":{"Os":0.25}}, want={"Ci":[[0.25]*3],"Oi":[[0.25]*3]})
C("opacity 0 ends shading","class x() { public void opacity(output color Oi) { Oi = s; } %s { Ci = 1; Oi = 1; } }"%S, {"variables":{"s":[0,1]}}, want={"Ci":[[0]*3,[1]*3],"Oi":[[0]*3,[1]*3]})
C("light(): class sets L, Cl","class x() { public void light(output vector L; output color Cl) { L = vector(0,0,3); Cl = 2; } }", want={"L":[[0,0,3]],"Cl":[[2]*3]})
C("light longer form by handle: compiles, warned","class x() { %s { shader a[] = getlights(); color c = 5; float i; for (i=0;i<arraylength(a);i+=1) a[i]->light(c, c, c, c); Ci = c; } }"%S, want={"Ci":[[5]*3]})
C("generatePhoton stays uncalled","class x() { public void light(output vector L; output color Cl) { L = vector(0,0,3); Cl = 2; } public void generatePhoton(output point o; output vector d; output color p; output float f) { o = P; } }", want={"Cl":[[2]*3]})
C("__computesRefinement","class x(float __computesRefinement = 1;) { public void refinement(output float r) { r = 1; } %s { Ci = 1; } }"%S, want={"Ci":[[1]*3]})
C("getvar(null) own parameter, member, global, none","class x(float q = 4;) { public float m = 5; %s { float a=0,b=0,c=9; color d=0; float k = getvar(null,\"q\",a)+getvar(null,\"m\",b)+getvar(null,\"Cs\",d)+getvar(null,\"none\",c); Ci = color(a+b, k, c); Oi = d; } }"%S, {"variables":{"Cs":0.5}}, want={"Ci":[[9,3,9]],"Oi":[[0.5]*3]})
C("readprimvar: parameter, global, array, none","class x(varying float w = 1; float list[2] = {5,6};) { %s { float a=0, c=9; point p=0; float l[2]; float k = readprimvar(\"w\",a)+readprimvar(\"P\",p)+readprimvar(\"list\",l)+readprimvar(\"none\",c); Ci = color(a, p[0], l[1]); Oi = color(k, c, 0); } }"%S, {"variables":{"w":[2,3],"P":[[7,0,0],[8,0,0]]}}, want={"Ci":[[2,7,6],[3,8,6]],"Oi":[[3,9,0]]*2})
C("readprimvar: variables that no parameter declares","class x() { %s { float a=1; color c=2; vector w=3; float k = readprimvar(\"dirt\",a)+10*readprimvar(\"tint\",c)+100*readprimvar(\"dirt\",w)+1000*getvar(null,\"tint\"); Ci = color(a, k, w[1]); Oi = c; } }"%S, {"variables":{"s":[0,1],"dirt":[0.25,0.75],"tint":[[1,2,3],[4,5,6]]}}, want={"Ci":[[0.25,11,3],[0.75,11,3]],"Oi":[[1,2,3],[4,5,6]]})
C("readprimvar and getvar: names made at run time","class x(string what = \"di\"; float Kd = 8; float list[3] = {4,5,6};) { public float seen = 3; %s { float a=1, b=0, c=0, l[]; point p = 0; string n[2] = {\"Kd\", \"seen\"}; uniform float i; float k = readprimvar(concat(what,\"rt\"),a) + 10*getvar(null,concat(what,\"rty\"),b); for (i=0;i<2;i+=1) k += 100*getvar(this, n[i], b) + b; k += 1000*readprimvar(format(\"%%s\",\"P\"),p) + 10000*readprimvar(concat(\"li\",\"st\"),l); Ci = color(a, k, p[0] + arraylength(l)); } }"%S, {"variables":{"dirt":[0.25,0.75],"P":[[7,0,0],[8,0,0]]}}, want={"Ci":[[0.25,11212,10],[0.75,11212,11]]})
C("attribute and option: names and lists at run time","class x(string what = \"user:\";) { %s { float l[], none[]; color c[]; string t[]; push(none, 4); float k = attribute(concat(what,\"list\"),l) + 10*attribute(\"user:triples\",c) + 100*option(concat(what,\"names\"),t) + 1000*attribute(concat(what,\"no\"),none); Ci = color(k, arraylength(l)+10*arraylength(c)+100*arraylength(t)+1000*arraylength(none), l[2]+comp(c[1],1)); Oi = t[1] == \"b\" ? 1 : 0; } }"%S, {"attributes":{"user:list":[1,2,3,4,5],"user:triples":[[1,2,3],[4,50,6]]},"options":{"user:names":["a","b","c"]}}, want={"Ci":[[111,1325,53]],"Oi":[[1]*3]})
C("readprimvar in a plain surface","surface x(varying float w = 1;) { float a=0; readprimvar(\"w\",a); Ci = a; }", {"variables":{"w":3}}, want={"Ci":[[3]*3]})
C("hasmethod 1 or 0","class x() { public float f() { return 1; } %s { Ci = color(hasmethod(this,\"f\"), hasmethod(this,\"g\"), hasmethod(null,\"f\")); } }"%S, want={"Ci":[[1,0,0]]})
V="class v(string __category = \"a,b\"; float gain = 2;) { public float seen = 1; public void begin() { seen = s; } public float value(float q) { return gain*q; } public void set(output color c) { c = 7; } public void displacement(output point P; output normal N) { P += 1; } }"
C("getvar of one of several co-shaders by a name made at run time","class x(string what = \"gain\";) { %s { shader a = s > 0 ? getshader(\"v\") : getshader(\"o\"); float q = 5; float k = getvar(a, what, q); Ci = color(q, k, getvar(a, concat(\"none\", what), q)); } }"%S, {"variables":{"s":[0,1]}}, want={"Ci":[[5,0,0],[2,1,0]]}, co=[("v",V),("o","shader o(float k = 6;) { }")])
C("getshader, members, methods, getshaders queries","class x() { %s { shader a = getshader(\"v\"); color c = 0; a->set(c); shader l[] = getshaders(\"category\",\"a&b\"), m[] = getshaders(\"category\",\"a&-b\"), n[] = getshaders(\"category\",\"-x\"), o[] = getshaders(\"category\",\"x,b\"); Ci = color(a->value(3), a->seen, c[0]); Oi = color(arraylength(l), arraylength(m), arraylength(n)+arraylength(o)); } }"%S, {"variables":{"s":[4]}}, want={"Ci":[[6,4,7]],"Oi":[[1,0,2]]}, co=[("v",V)])
C("sh->displacement(P, N)","class x() { %s { shader a = getshader(\"v\"); point q = 0; normal n = 0; a->displacement(q, n); Ci = color q; } }"%S, want={"Ci":[[1]*3]}, co=[("v",V)])
C("missing member, method, null at run time: warned, kept, 0","class x() { %s { shader a = getshader(\"v\"), z = getshader(\"zz\"); color c = 3; a->nothing(c); z->set(c); Ci = color(c[0], z->value(1), a->value(1)); } }"%S, want={"Ci":[[3,0,2]]}, co=[("v",V)])
C("co-shader of 1.x: surface(c,o), outputs","class x() { %s { shader a = getshader(\"o\"); color c=0, o=0; a->surface(c, o); Ci = c; Oi = o; } }"%S, want={"Ci":[[2]*3],"Oi":[[1]*3]}, co=[("o","surface o() { Ci = 2; Oi = 1; }")])
C("shader o(..) { } reads outputs","class x() { %s { shader a = getshader(\"o\"); Ci = a->result; } }"%S, want={"Ci":[[6]*3]}, co=[("o","shader o(float k = 6; output color result = 0;) { result = k; }")])
C("__radiancesample members and methods","class x() { %s { __radiancesample a[]; resize(a,1); a[0]->setMaterialResponse(color 2, 0.5); a[0]->setLightSample(color 3, 0.25); a[0]->setRadiance(color 4); Ci = a[0]->materialResponse + a[0]->radiance; Oi = color(a[0]->materialPdf, a[0]->lightPdf, a[0]->valid); } }"%S, want={"Ci":[[6]*3],"Oi":[[0.5,0.25,1]]})
C("directlighting parameters","class x() { public void evaluateSamples(string w; output __radiancesample r[]) { float i; for (i=0;i<arraylength(r);i+=1) r[i]->setMaterialResponse(color 1, 1); } public void lighting(output color Ci, Oi) { color d=0,p=0,u=0,v=0,ir=0; string g[2]={\"a\",\"b\"}; color gd[2], gs[2], ud[2], us[2]; Ci = directlighting(this, getlights(), \"diffuseresult\", d, \"specularresult\", p, \"unshadoweddiffuseresult\", u, \"unshadowedspecularresult\", v, \"irradianceresult\", ir, \"mis\", 1, \"diffusemis\", 0, \"heuristic\", \"balance\", \"integrationdomain\", \"sphere\", \"lightgroups\", g, \"groupeddiffuseresults\", gd, \"groupedspecularresults\", gs, \"groupedunshadoweddiffuseresults\", ud, \"groupedunshadowedspecularresults\", us); } }")
C("indirectspecular parameters","class x() { public void generateSamples(string w; output __radiancesample r[]) {} public void lighting(output color Ci, Oi) { float q=2; Ci = indirectspecular(this, \"samplebase\", 1, \"subset\", \"a\", \"maxdist\", 3, \"integrationdomain\", \"sphere\", \"position\", P, \"usemotionbias\", 1, \"send:surface:q\", q); } }")
C("indirectdiffuse parameters","class x() { public void lighting(output color Ci, Oi) { Ci = indirectdiffuse(P, N, 16, \"adaptive\", 1, \"maxvariation\", 0.1, \"maxdist\", 3, \"samplebase\", 1, \"environmentmap\", \"\", \"environmentspace\", \"world\", \"environmentcolor\", color 0, \"environmentdir\", vector 0, \"pointbased\", 1, \"filename\", \"\"); } }")
C("emit in prelighting","class x() { public void prelighting(output color Ci, Oi) { emit(color 1, \"areanormalized\", 1, \"raytraceshadows\", 1, \"shadowbias\", 0.1, \"cosinepower\", 1); } %s { Ci = 3; } }"%S, want={"Ci":[[3]*3]})
for h,st in (("ShadingContext","ShadingContext"),("SampleMgr","SampleMgr"),("Fresnel","Fresnel"),("Lambert","Lambert"),("SpecularAS","SpecularAS"),("SpecularBlinn","SpecularBlinn"),("SpecularDBRDF","SpecularDBRDF"),("IsotropicVolume","IsotropicVolume"),("RadianceSample","RadianceSample"),("AreaSampler","AreaSampler"),("SphericalHarmonics","SphericalHarmonic"),("Hair","Hair"),("OrenNayar","OrenNayar"),("Colors",""),("Math","")):
    C("<stdrsl/%s.h> brings ShadingContext, Fresnel, SampleMgr"%h,"#include <stdrsl/%s.h>\nclass x() { stdrsl_ShadingContext c; stdrsl_Fresnel f; stdrsl_SampleMgr m; %s public void begin() { c->construct(); c->init(); f->init(c, 1, 1.5); } %s { Ci = f->m_Kr; } }"%(h,"stdrsl_%s own;"%st if st else "",S),{"variables":{"N":[0,0,1],"I":[0,0,-1]}}, want={"Ci":[[0.04]*3]})
C("SampleMgr into a uniform member after rayinfo","#include <stdrsl/ShadingContext.h>\nclass x(float samples = 64;) { stdrsl_ShadingContext m_ctx; uniform float m_n = 0; uniform float m_v = 0; uniform float m_own = 0; public void construct() { m_ctx->construct(); } public void begin() { m_ctx->init(); m_ctx->m_SampleMgr->computeDepthBasedSampleReduction(m_ctx->m_RayDepth, samples, 4, 1, m_n); m_ctx->m_SampleMgr->computeIndirectDiffuseSamples(samples, 0.1, m_own, m_v); float d = 0; rayinfo(\"depth\", d); float half = samples; if (d > 0) half = samples / 2; m_own = half; } %s { Ci = color(m_n, m_own, m_v); } }"%S, {"rayinfo":{"depth":1,"diffusedepth":1}}, want={"Ci":[[16,32,0.2]]})
C("stdrsl_ShadingUtils GetShadingVars","#include <stdrsl/ShadingContext.h>\nclass x() { stdrsl_ShadingUtils u; %s { normal a,c,d; vector b; u->GetShadingVars(0, 2, a, b, c, d); Ci = color d; } }"%S,{"variables":{"N":[0,0,-2],"I":[0,0,-1]}}, want={"Ci":[[0,0,1]]})
C("SampleMgrPathTrace","#include <stdrsl/SampleMgr.h>\nclass x() { stdrsl_SampleMgrPathTrace m; uniform float n=0; public void construct() { m->construct(); } public void begin() { m->begin(); m->computeLightSamples(2, 8, n); } %s { Ci = n; } }"%S, want={"Ci":[[8]*3]})
C("SphericalHarmonic","#include <stdrsl/SphericalHarmonics.h>\nclass x() { stdrsl_SphericalHarmonic a, b; %s { color c[9] = {1,2,3,4,5,6,7,8,9}; float f[4] = {1,10,100,1000}; a->createFromArray(c); b->createFromArray(f); color before = a->convolve(b, 0); a->rotate(\"shader\"); Ci = before; Oi = a->convolve(b, 0); } }"%S, want={"Ci":[[4321]*3],"Oi":[[4321]*3]})
C("writeaov readaov","class x() { %s { float q=0; writeaov(\"d\", 3); readaov(\"d\", q); Ci = q; } }"%S, want={"Ci":[[3]*3],"d":[3]})
C("stof sprintf strlen capacity pop reserve","class x() { %s { float a[]; reserve(a,5); push(a,1); push(a,2); float p = pop(a); Ci = color(stof(sprintf(\"%%g\",2.5)), strlen(\"abcd\"), p + arraylength(a)); } }"%S, want={"Ci":[[2.5,4,3]]})
C("filterregion methods; texture, environment with it","class x() { %s { filterregion f; f->calculate2d(s,t); f->calculate2d(s,t,1,0,0,1); f->calculate3d(P); f->calculate3d(P,dPdu,dPdv); f->scale(2); f->blur(0.1); Ci = 1 + 0*texture(\"\", f); } }"%S, want=None)
C("environment(map, fr)","class x() { %s { filterregion f; f->calculate3d(P); Ci = color environment(\"\", f); } }"%S)
C("gather with fr (dir, angle)","class x() { %s { filterregion f; f->calculate3d(P); color h=0; gather(\"illuminance\", P, f, 4, \"surface:Ci\", h) { Ci += h; } } }"%S)
C("ptexture(file, channel, face, fr)","class x() { %s { filterregion f; f->calculate2d(s,t); Ci = 2 + color ptexture(\"a.ptx\", 0, 3, f); } }"%S, want={"Ci":[[2]*3]})
C("areashadow(map, fr, s, ..)","class x() { %s { filterregion f; f->calculate3d(P); __radiancesample a[]; resize(a,1); a[0]->radiance = 3; areashadow(\"\", f, a, \"raytrace\", 1, \"bias\", 0.1); Ci = a[0]->radiance; } }"%S, want={"Ci":[[3]*3]})
C("generateSamplesAS, evaluateSamplesAS","class x() { %s { __radiancesample a[]; generateSamplesAS(color 1, 4, 100, 100, N, dPdu, -normalize(I), a); float n = arraylength(a); resize(a, 1); a[0]->direction = vector(0,0,1); evaluateSamplesAS(color 1, 4, 4, N, dPdu, -normalize(I), a); Ci = color(n > 0, comp(a[0]->materialResponse, 0), a[0]->materialPdf); } }"%S, {"variables":{"N":[0,0,1],"I":[0,0,-1],"dPdu":[1,0,0]}}, want={"Ci":[[1,5/(8*3.14159265),5/(8*3.14159265)]]})
C("generateSamplesEnv, evaluateSamplesEnv","class x() { %s { __radiancesample a[]; generateSamplesEnv(\"\", P, N, 4, a); Ci = arraylength(a); } }"%S, {"variables":{"N":[0,0,1]}}, want={"Ci":[[4]*3]})
C("randomstrat","class x() { %s { vector a[4]; randomstrat(0, 4, a); Ci = color(floor(4*a[2][0]), a[2][1] < 1, a[2][2]); } }"%S, want={"Ci":[[2,1,0]]})
C("subsurface(P, N, ..), (\"raytraced\", ..)","class x() { %s { Ci = 0*subsurface(P, N, \"filename\", \"a.ptc\", \"albedo\", color 1, \"diffusemeanfreepath\", color 1, \"ior\", 1.5, \"unitlength\", 1, \"smooth\", 1, \"maxsolidangle\", 1) + 0*subsurface(\"raytraced\", P, N, \"albedo\", color 1); } }"%S)
C("photonmap(file, P, N, \"estimator\", n); caustic","class x() { %s { Ci = photonmap(\"a\", P, N, \"estimator\", 9) + caustic(P, N); } }"%S)
C("texture3d, bake3d with arrays","class x() { %s { float a[2] = {1,2}; color c[2] = {3,4}; float k = texture3d(\"none.ptc\", P, N, \"a\", a, \"c\", c); k += 10 * bake3d(\"\", \"\", P, N, \"a\", a); Ci = color(a[1], c[1][0], k); } }"%S, want={"Ci":[[2,4,10]]})
C("gridmin gridmax gridnever erf erfc","class x() { %s { Ci = color(gridmin(s)+gridmax(s), erf(0.5), erfc(0.5)); Oi = gridnever(0); } }"%S, {"variables":{"s":2}}, want={"Ci":[[4,0.5204999,0.4795001]],"Oi":[[1]*3]})
C("wnoise textureatlas rbug","class x() { %s { rbug(Ci); Ci = textureatlas(\"a\", s, t); } }"%S, want={"Ci":[[0]*3]})
C("wnoise: noise of a band, its mean where the filter is wider","class x() { %s { Ci = color(wnoise(P, 0) - float noise(P), wnoise(P, 1), wnoise(s, 2)); Oi = color wnoise(P, 1); } }"%S, {"variables":{"P":[[.3,.4,.5]],"s":.25}}, want={"Ci":[[0,.5,.5]],"Oi":[[.5]*3]})
C("gather weight, environment:file","class x() { %s { color q=0; float w=0; gather(\"environment:a.env\", P, N, 0.5, 4, \"environment:color\", q, \"weight\", w) { Ci += q; } } }"%S)
C("trace raytype","class x() { %s { Ci = trace(P, N, \"raytype\", \"specular\"); } }"%S)
C("illuminance lightcache","class x() { %s { illuminance(P, N, 1.57, \"lightcache\", \"reuse\") { Ci += Cl; } } }"%S)
C("rayinfo names","class x() { %s { string t=\"\", l=\"\", i=\"\"; float d=9,e=9,f=9,g=9; color im=0; float k = rayinfo(\"type\",t)+rayinfo(\"label\",l)+rayinfo(\"depth\",d)+rayinfo(\"diffusedepth\",e)+rayinfo(\"speculardepth\",f)+rayinfo(\"shadowdepth\",g)+rayinfo(\"shadingintent\",i)+rayinfo(\"importance\",im); float lod=9; k += rayinfo(\"integrationlod\", lod); Ci = color(k, d+e+f+g, lod); } }"%S)
C("attribute, option names","class x() { uniform float a=0,b=0,c=0; color d=0,e=0; string n=\"\"; float f=0,g=0; %s { float k = attribute(\"Sides\",a)+attribute(\"ShadingRate\",b)+attribute(\"Matte\",c)+attribute(\"Ri:Color\",d)+attribute(\"Ri:Opacity\",e)+attribute(\"identifier:name\",n)+attribute(\"trace:bias\",f)+attribute(\"trace:maxdiffusedepth\",g); float o=0,p=0; k += 100*(option(\"Frame\",o)+option(\"trace:maxdepth\",p)); Ci = k; } }"%S)
C("textureinfo exists, shcoeffs","class x() { %s { uniform float e=9; float c[9]; float k = textureinfo(\"none.tx\",\"exists\",e); k += 10*textureinfo(\"none.tx\",\"shcoeffs\",c); Ci = color(k, e, 0); } }"%S)
C("dialect: ; before )","class x(float a = 1; float b = 2;;) { float f(float q; float r;) { return q+r; } %s { Ci = f(a,b); } }"%S, want={"Ci":[[3]*3]})
C("dialect: #pragma between formals","class x(float a = 1;\n#pragma annotation a \"x\"\nfloat b = 2;) { %s { Ci = a+b; } }"%S, want={"Ci":[[3]*3]})
C("dialect: output parameter without default","class x(output varying float d;) { %s { d = 3; Ci = 1; } }"%S, want={"d":[3]})
C("dialect: int as a name","class x() { %s { float int = 3; Ci = int; } }"%S, want={"Ci":[[3]*3]})
C("dialect: two structs a declaration","struct A { float k=1; } class x() { A a, b; %s { b->k = 2; Ci = a->k+b->k; } }"%S, want={"Ci":[[3]*3]})
C("dialect: ;, and ;; and x; # text","class x(float a = 1;, float b = 2;;) { %s { float c = a;; # a remark\n Ci = c+b; } }"%S, want={"Ci":[[3]*3]})
C("dialect: block macros","#define B(x) { Ci += x; Oi = 1; }\nclass x() { %s { Ci = 1; B(2) } }"%S, want={"Ci":[[3]*3]})
C("dialect: plugin","plugin \"x\";\nclass x() { %s { Ci = 1; } }"%S, want={"Ci":[[1]*3]})
M="class m(float gain = 2;) { public void evaluateSamples(string w; output __radiancesample r[]) { float i; for (i=0;i<arraylength(r);i+=1) r[i]->setMaterialResponse(color gain * (w == \"diffuse\" ? 1 : 10), 1); } public void generateSamples(string w; output __radiancesample r[]) { __radiancesample one; one->setMaterialSample(color gain, 1, vector(0,0,1), 1e30); push(r, one); } }"
LAMP={"lights":[{"file":"sun.sl","handle":"sun"}]}
SUN="light sun(float intensity = 3; color tint = 4; string word = \"w\";) { solar(vector \"world\" (0,0,-1), 0) Cl = intensity; }"
C("directlighting, indirectspecular of another shader","class x(shader m = null;) { public void lighting(output color Ci, Oi) { color d = 0, p = 0; __radiancesample r[]; Ci = directlighting(m, getlights(), \"diffuseresult\", d, \"specularresult\", p, \"materialsamples\", r); Ci = color(d[0]/PI, p[0]/PI, arraylength(r)) + indirectspecular(m); } }", {"parameters":{"m":"m"}}|LAMP, want={"Ci":[[6,60,1]]}, co=[("m",M),("sun",SUN)])
C("array of structs that hold arrays","struct A { float k[3] = {1,2,3}; float w = 7; } class x() { A a[2]; %s { float i, sum = 0; a[1]->k[2] = 5; a[0] = a[1]; a[0]->k[0] = s; for (i = 0; i < 3; i += 1) sum += a[0]->k[i] * (1 + 9 * i); A b[]; push(b, a[1]); push(b, a[0]); Ci = color(sum, b[0]->k[2] + b[1]->w, arraylength(b) + b[1]->k[0]); } }"%S, {"variables":{"s":[4,6]}}, want={"Ci":[[4+20+95,12,6],[6+20+95,12,8]]})
C("members restart from defaults at begin","class x() { float n = 1; public void begin() { n += 1; } %s { Ci = n; } }"%S, {"variables":{"s":[0,1,2]}}, want={"Ci":[[2]*3]*3})
C("resize zeroes new elements","class x() { %s { float a[]; push(a,5); resize(a,0); resize(a,2); Ci = a[0]; } }"%S, want={"Ci":[[0]*3]})
C("arrays bounds checked","class x() { %s { float a[2] = {1,2}; Ci = 1 + a[s]; } }"%S, {"variables":{"s":5}}, want={"Ci":[[3]*3]}, said="SHADER_FAULT")
C("idioms in plain surfaces: struct, arrays, float x = cond","struct A { float k = 2; } surface x() { A a; float b[]; push(b, 3); float c = s > 0; Ci = color(a->k, b[0], c); }", {"variables":{"s":1}}, want={"Ci":[[2,3,1]]})
C("constant storage","class x() { constant float k = 3; constant float t[2] = {1,2}; %s { Ci = k + t[1]; } }"%S, want={"Ci":[[5]*3]})
C("default arguments","class x() { float f(float a = 1; float b = 2) { return a+b; } %s { Ci = f() + f(5); } }"%S, want={"Ci":[[10]*3]})
C("lights[i]->name","class x() { %s { shader a[] = getlights(); string w = a[0]->word; Ci = a[0]->intensity; Oi = a[0]->tint; float k = a[0]->intensity; Oi += k; if (w != \"w\") Oi = 0; } }"%S, LAMP, want={"Ci":[[3]*3],"Oi":[[7]*3]}, co=[("sun",SUN)])
TORCH="light torch(float intensity = 3; color tint = 4; float weights[3] = {1,2,7}; string words[2] = {\"a\",\"b\"};) { solar(vector \"world\" (0,0,-1), 0) Cl = intensity; }"
C("getvar of lights and lightsource: names made at run time, lists","class x(string what = \"inten\";) { %s { shader a[] = getlights(); string n[3] = {\"intensity\", \"tint\", \"none\"}; uniform float i; float q = 0, k = 0, v = 0, w[], none[]; color c = 0; string t[]; push(none, 1); for (i = 0; i < 3; i += 1) { k += getvar(a[0], n[i], q) + 10*getvar(a[0], n[i], c); } illuminance(P) { k += 100*lightsource(concat(what,\"sity\"), v) + 1000*lightsource(\"weights\", w) + 10000*lightsource(format(\"%%s\",\"words\"), t) + 100000*lightsource(\"none\", none); } Ci = color(k, q + c[1] + v, arraylength(w) + 10*arraylength(t) + 100*arraylength(none)); Oi = color(w[2], t[1] == \"b\" ? 1 : 0, 0); } }"%S, LAMP, want={"Ci":[[11111,10,123]],"Oi":[[7,1,0]]}, co=[("sun",TORCH)])
C("textureinfo into a resizable array keeps it where the file is missing","class x() { %s { float r[]; push(r, 4); float k = textureinfo(\"missing.tif\", \"resolution\", r); Ci = color(k, arraylength(r), r[0]); } }"%S, want={"Ci":[[0,1,4]]})
C("lights[i]->name that it has not: 0, warned","class x() { %s { shader a[] = getlights(); Ci = 1 + a[0]->nothing; } }"%S, LAMP, want={"Ci":[[1]*3]}, co=[("sun",SUN)])
C("all[i]->member of co-shaders","class x() { %s { shader a[] = getshaders(); float i; Ci = 0; for (i = 0; i < arraylength(a); i += 1) Ci += color(a[i]->k, a[i]->c[1], a[i]->seen); } }"%S, {"variables":{"s":5}}, want={"Ci":[[3+4,2+2,10]]}, co=[("p","class p(float k = 3; color c = color(1,2,3);) { public float seen = 0; public void begin() { seen = s; } }"),("q","class q(float k = 4; color c = color(1,2,3);) { public float seen = 0; public void begin() { seen = s; } }")])


class Rsl2(Points):
    def test_each_fact(self):
        self.assertGreater(len(CASES), 110)
        self.assertEqual(len({case[0] for case in CASES}), len(CASES))
        for clause, source, document, want, co, code, said in CASES:
            with self.subTest(clause):
                lights = {one["handle"] for one in document.get("lights", [])}
                if co.keys() - lights:
                    document = document | {"coshaders": [{"handle": h, "file": h + ".sl"} for h in co
                                                         if h not in lights]}
                result = self.shade_points(source, document, **co)
                self.expect(result, code, said)
                if want:
                    self.check(source, document, want, **co)


if __name__ == "__main__":
    main()
