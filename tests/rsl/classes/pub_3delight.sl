/* 3Delight-for-Maya manner: output AOVs with structs passed through */
#ifndef __util
#define __util
void accumulate(output color io_c; uniform float i_w; color i_add)
{
	io_c += i_w * i_add;
}
float luminance(color c) { return comp(c,0)*0.2126 + comp(c,1)*0.7152 + comp(c,2)*0.0722; }
#endif
class dl_lambert
(
	float i_diffuse = 0.8;
	color i_color = color(.5);
	color i_incandescence = color(0.0, 0.0, 0.0);
	color i_transparency = color(0);
	point i_normalCamera = 0;
	float i_translucence = 0;
	output color o_outColor = 0;
	output color o_outTransparency = 0;
	output color aov_ambient = 0, aov_diffuse = 0;
	output varying float aov_lum = 0;
)
{
	public constant string kind = "lambert";
	public varying color lastDiffuse = 0;
	public void shade(normal i_N; output color o_c; output color o_t) {
		extern point P;
		vector Nf = faceforward(normalize(i_N), I);
		color d = 0;
		illuminance("", P, Nf, PI/2, "lightcache", "reuse") {
			float nonDiff = 0;
			lightsource("__nondiffuse", nonDiff);
			if (nonDiff < 1)
				d += Cl * (1 - nonDiff) * (normalize(L) . Nf);
		}
		lastDiffuse = d;
		o_c = 0;
		accumulate(o_c, i_diffuse, i_color * d);
		accumulate(o_c, 1, i_incandescence);
		o_t = i_transparency;
	}
	public void surface(output color Ci, Oi) {
		shade(N, o_outColor, o_outTransparency);
		aov_diffuse = o_outColor;
		aov_lum = luminance(o_outColor);
		Oi = Os * (color 1 - o_outTransparency);
		Ci = o_outColor * Oi;
	}
};
