//! What of a program is a target and what is not: languages against states. Each row is a program, the
//! names of what is corrected, what is left with a word of its reason, and words of what is listed.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use std::sync::OnceLock;

use crate::compensating;
use truepose::compensation::VerifiedCalibration;
use truepose::pipeline;
use truepose::programs::{
    Answer, CompensateError, DifferingNumber, ExternalAxes, ProgramFrames, Request, find,
};

fn arm() -> &'static VerifiedCalibration {
    static ARM: OnceLock<VerifiedCalibration> = OnceLock::new();
    ARM.get_or_init(|| crate::exporting::admitted(&compensating::calibration()))
}

/// Stands for literals that the arm reaches.
const LITERALS: [(&str, &str); 9] = [
    (
        "@ROB",
        "[[162.222,61.710,586.163],[0.2102361,-0.3256699,0.2949246,-0.8733609],[0,0,1,1],[9E9,9E9,9E9,9E9,9E9,9E9]]",
    ),
    (
        "@AT",
        "[162.222,61.710,586.163],[0.2102361,-0.3256699,0.2949246,-0.8733609],[0,0,1,1]",
    ),
    (
        "@JNT",
        "[[106,65,-25,-63,-53,-18],[9E9,9E9,9E9,9E9,9E9,9E9]]",
    ),
    (
        "@XYZ",
        "X 162.2216,Y 61.7095,Z 586.1627,A -141.3534,B -26.4136,C -46.7269",
    ),
    ("@ST", "S 0,T 18"),
    ("@AXS", "A1 106,A2 65,A3 -25,A4 -63,A5 -53,A6 -18"),
    (
        "@UPO",
        "p[0.162222,0.06171,0.586163,-0.905393,0.819918,-2.428025]",
    ),
    ("@ULI", "[2.21,0.54,-0.13,-0.69,-0.37,-2.74]"),
    (
        "@FXY",
        // In the world of a FANUC, whose origin is at the height of axis 2, here 290 mm.
        "CONFIG : 'N U T, 0, 0, 0', X = 162.222 mm, Y = 61.710 mm, Z = 296.163 mm, W = -46.7269 deg, P = -26.4136 deg, R = -141.3534 deg",
    ),
];

fn written(program: &str) -> String {
    let mut text = program.to_owned();
    for (word, literal) in LITERALS {
        text = text.replace(word, literal);
    }
    text
}

fn corrected(
    language: &str,
    program: &str,
    frames: ProgramFrames,
) -> Result<Answer, CompensateError> {
    pipeline::compensate(&Request {
        calibration: arm(),
        bytes: program.as_bytes(),
        language: find(language).unwrap(),
        file: None,
        beside: Vec::new(),
        load_kg: 0.0,
        start: Some(vec![2.2, 0.5, -0.1, -0.6, -0.4, -2.7]),
        frame: None,
        tool: None,
        frames,
        measured_frame: false,
    })
}

/// State, language, program, corrected, left (name, reason, word), listed.
type Row = (
    &'static str,
    &'static str,
    &'static str,
    &'static [&'static str],
    &'static [(&'static str, &'static str, &'static str)],
    &'static [&'static str],
);

#[rustfmt::skip]
const TABLE: &[Row] = &[
    // An ordinary program, and a base that moves.
    ("ordinary", "rapid", "CONST robtarget p:=@ROB;\nCONST jointtarget j:=@JNT;\nMoveAbsJ j,v9,fine,t;\nMoveL p,v9,fine,t;\n", &["p", "j"], &[], &[]),
    ("ordinary", "krl", "DEF m()\nDECL E6POS XP\nXP={@XYZ,@ST}\nPTP {@AXS}\nLIN XP\nEND\n", &["XP", "target of PTP"], &[], &[]),
    ("ordinary", "urscript", "def m():\n q=@ULI\n movej(q)\n movel(@UPO)\nend\n", &["q", "target of movel"], &[], &[]),
    ("ordinary", "fanuc-ls", "/MN\n 1:J P[1] 9% FINE ;\n 2:L P[2] 9mm/sec FINE ;\n/POS\nP[1]{ J1= 106 deg, J2= 65 deg, J3= -25 deg, J4= -63 deg, J5= -53 deg, J6= -18 deg };\nP[2]{ GP1: UF : 0, UT : 1, @FXY };\n", &["P[1]", "P[2]"], &[], &[]),
    ("moving base", "krl", "BAS(#EX_BASE,1)\nLIN {@XYZ,@ST}\n", &[], &[("target of LIN", "frame", "EX_BASE")], &[]),
    ("moving base", "krl", "$BASE=EK(MACHINE_DEF[2].ROOT,MACHINE_DEF[2].MECH_TYPE,{X 0,Y 0,Z 0,A 0,B 0,C 0})\nLIN {@XYZ,@ST}\nPTP {@AXS}\n", &["target of PTP"], &[("target of LIN", "frame", "run time")], &[]),
    // A work frame that moves.
    ("moving work frame", "rapid", "PERS wobjdata w:=[FALSE,FALSE,\"STN1\",[[0,0,0],[1,0,0,0]],[[0,0,0],[1,0,0,0]]];\nCONST robtarget p:=@ROB;\nMoveL p,v9,fine,t\\WObj:=w;\n", &[], &[("p", "frame", "moved by the robot or by another unit")], &[]),
    ("moving work frame", "rapid", "PERS wobjdata w:=[TRUE,TRUE,\"\",[[0,0,0],[1,0,0,0]],[[0,0,0],[1,0,0,0]]];\nMoveL @ROB,v9,fine,t\\WObj:=w;\n", &[], &[("target of MoveL", "frame", "moved by the robot")], &[]),
    ("moving work frame", "fanuc-ls", "/MN\n 1:L P[1] 9cm/min CNT100 COORD ;\n 2:L P[2] 9mm/sec FINE ;\n/POS\nP[1]{ GP1: UF : 0, UT : 1, @FXY GP2: J1= 10 deg };\nP[2]{ GP1: UF : 0, UT : 1, @FXY GP2: J1= 20 deg };\n", &["P[2]"], &[("P[1]", "frame", "COORD")], &[]),
    ("moving work frame", "fanuc-ls", "/APPL\n LINE_TRACK;\n LINE_TRACK_SCHEDULE_NUMBER : 1;\n/MN\n 1:L P[1] 9mm/sec FINE ;\n/POS\nP[1]{ GP1: UF : 0, UT : 1, @FXY };\n", &[], &[("P[1]", "frame", "conveyor")], &[]),
    ("moving work frame", "urscript", "def m():\n track_conveyor_linear(p[1,0,0,0,0,0],500)\n movel(@UPO)\n stop_conveyor_tracking()\n movel(@UPO)\nend\n", &["target of movel"], &[("target of movel", "frame", "track_conveyor_linear")], &["track_conveyor"]),
    ("moving work frame", "rapid", "MoveL @ROB,v9,fine,t;\nPDispSet d;\nMoveL @ROB,v9,fine,t;\nPDispOff;\nMoveL @ROB,v9,fine,t;\n", &["target of MoveL", "target of MoveL"], &[("target of MoveL", "frame", "pdispset")], &["pdispset"]),
    // The tool stands, the robot moves the part.
    ("stationary tool", "krl", "$IPO_MODE=#TCP\nLIN {@XYZ,@ST}\nPTP {@AXS}\n$IPO_MODE=#BASE\nLIN {@XYZ,@ST}\n", &["target of LIN"], &[("target of LIN", "frame", "#TCP"), ("target of PTP", "frame", "#TCP")], &[]),
    ("stationary tool", "rapid", "PERS tooldata s:=[FALSE,[[1,2,3],[1,0,0,0]],[1,[0,0,1],[1,0,0,0],0,0,0]];\nMoveL @ROB,v9,fine,s;\nMoveAbsJ @JNT,v9,fine,s;\n", &[], &[("target of MoveAbsJ", "frame", "does not sit on the robot"), ("target of MoveL", "frame", "does not sit on the robot")], &[]),
    ("stationary tool", "krl", "DEFDAT m\nDECL FDAT FP={TOOL_NO 0,BASE_NO 0,IPO_FRAME #TCP,POINT2[] \" \"}\nDECL E6POS XP={@XYZ,@ST}\nENDDAT\n", &[], &[("XP", "frame", "#TCP")], &[]),
    // Frames by their number.
    ("numbered frame", "krl", "DEF m()\nFDAT_ACT=FP1\nBAS(#PTP_PARAMS,100)\nPTP XP1\nEND\nDEFDAT m\nDECL E6POS XP1={@XYZ,@ST}\nDECL FDAT FP1={TOOL_NO 0,BASE_NO 3,IPO_FRAME #BASE}\nENDDAT\n", &[], &[("XP1", "frame", "BASE_DATA[3]")], &[]),
    ("numbered frame", "krl", "DEFDAT m\nDECL E6POS XP1={@XYZ,@ST}\nDECL FDAT FP1={TOOL_NO 1,BASE_NO 3,IPO_FRAME #BASE,POINT2[] \" \",TQ_STATE FALSE}\nDECL PDAT PPDAT1={VEL 100.0,ACC 100.0,APO_DIST 100.0}\nDECL E6POS XP2={@XYZ,@ST}\nDECL FDAT FP2={TOOL_NO 1,BASE_NO 0,IPO_FRAME #BASE}\nENDDAT\n", &["XP2"], &[("XP1", "frame", "BASE_DATA[3]")], &[]),
    ("numbered frame", "krl", "DEF m()\nDECL FDAT FP1={TOOL_NO 0,BASE_NO 0,IPO_FRAME #BASE}\nDECL E6POS XP1={@XYZ,@ST}\nSPTP XP1 WITH $VEL_AXIS[1]=SVEL_JOINT(100.0), $TOOL=STOOL2(FP1), $BASE=SBASE(FP1.BASE_NO), $IPO_MODE=SIPO_MODE(FP1.IPO_FRAME) C_Spl\nSLIN {@XYZ,@ST} WITH $TOOL=STOOL2(FP1), $BASE=BASE_DATA[2]\nEND\n", &["XP1"], &[("target of SLIN", "frame", "BASE_DATA[2]")], &[]),
    ("numbered frame", "fanuc-ls", "/MN\n 1:UFRAME_NUM=2 ;\n 2:L P[1] 9mm/sec FINE ;\n/POS\nP[1]{ GP1: UF : 2, UT : 1, @FXY };\n", &[], &[("P[1]", "frame", "UF 2")], &[]),
    ("numbered frame", "fanuc-ls", "/MN\n 1:UTOOL_NUM=1 ;\n 2:L P[1] 9mm/sec FINE ;\n 3:UTOOL_NUM=2 ;\n 4:L P[2] 9mm/sec FINE ;\n/POS\nP[1]{ GP1: UF : 0, UT : 2, @FXY };\nP[2]{ GP1: UF : 0, UT : 2, @FXY };\n", &["P[2]"], &[("P[1]", "frame", "UTOOL_NUM is 1")], &[]),
    ("numbered frame", "fanuc-ls", "/MN\n 1:UTOOL_NUM=2 ;\n 2:L P[2] 9mm/sec FINE ;\n/POS\nP[1]{ GP1: UF : 0, UT : 1, @FXY };\nP[2]{ GP1: UF : 0, UT : 2, @FXY };\n", &["P[2]"], &[("P[1]", "unused", "no motion")], &[]),
    // Ways from where the robot is.
    ("relative motion", "krl", "DEF m()\nDECL E6AXIS delta\ndelta={@AXS}\nPTP_REL delta\nLIN_REL {X 10}\nEND\n", &[], &[("delta", "relative", "PTP_REL")], &["PTP_REL is a relative", "LIN_REL is a relative"]),
    ("relative motion", "krl", "delta={A1 0,A2 0,A3 0,A4 0,A5 0,A6 10}\nptp_rel delta\nptp {@AXS}\n", &["target of ptp"], &[("delta", "relative", "ptp_rel")], &["relative"]),
    ("relative motion", "fanuc-ls", "/MN\n 1:L P[1] 9mm/sec FINE INC ;\n/POS\nP[1]{ GP1: UF : 0, UT : 1, @FXY };\n", &[], &[("P[1]", "relative", "INC")], &[]),
    ("relative motion", "urscript", "def m():\n d=p[0,0,0.1,0,0,0]\n movel(pose_add(get_actual_tcp_pose(),d))\nend\n", &[], &[], &["pose_add", "no move of this file uses"]),
    ("relative motion", "rapid", "MoveL Offs(CRobT(),0,0,9),v9,fine,t;\nMoveExtJ @JNT,v9,fine;\nMoveL *,v9,fine,t;\n", &[], &[], &["Offs", "external axes only", "goes to *"]),
    // Types of one's own, and arrays of numbers.
    ("own structure", "krl", "STRUC MYAX REAL A1,A2,A3,A4,A5,A6\nDECL MYAX lim\nlim={@AXS}\nDECL MYAX top={@AXS}\nPTP {@AXS}\n", &["target of PTP"], &[], &[]),
    ("own structure", "rapid", "CONST robjoint r:=[106,65,-25,-63,-53,-18];\nCONST robjoint rj{2}:=[[106,65,-25,-63,-53,-18],[1,2,3,4,5,6]];\nCONST o_robtarget o:=@ROB;\nCONST o_jointtarget oj:=@JNT;\nVAR myrec m:=@JNT;\nm:=@JNT;\nMoveAbsJ @JNT,v9,fine,t;\n", &["target of MoveAbsJ"], &[], &[]),
    ("array of numbers", "rapid", "CONST num nLimits{2,6}:=[[-100,-60,-90,-100,-90,-180],[100,80,60,100,90,180]];\nnLimits:=[[1,2,3,4,5,6],[1,2,3,4,5,6]];\nMoveAbsJ @JNT,v9,fine,t;\n", &["target of MoveAbsJ"], &[], &[]),
    ("array of numbers", "urscript", "def m():\n limits=[1,2,3,4,5,6]\n w=p[1,2,3,0,0,0]\n movej(@ULI)\nend\n", &["target of movej"], &[], &["w is a pose"]),
    ("array of targets", "rapid", "CONST jointtarget j{2}:=[@JNT,@JNT];\nMoveAbsJ j{1},v9,fine,t;\n", &["j{1}"], &[("j{2}", "unused", "no motion")], &[]),
    ("array of targets", "rapid", "CONST jointtarget j{2}:=[@JNT,@JNT];\nFOR i FROM 1 TO 2 DO\nMoveAbsJ j{i},v9,fine,t;\nENDFOR\n", &["j{1}", "j{2}"], &[], &[]),
    ("array of targets", "krl", "DECL E6AXIS P[2]\nP[1]={@AXS}\nP[2]={@AXS}\nPTP P[1]\n", &["P[1]"], &[("P[2]", "unused", "no motion")], &[]),
    // One name in two routines is two names.
    ("two scopes", "rapid", "MODULE m\nPROC a()\nCONST jointtarget j:=@JNT;\nMoveAbsJ j,v9,fine,t;\nENDPROC\nPROC b()\nCONST jointtarget j:=@JNT;\nPDispSet d;\nMoveAbsJ j,v9,fine,t;\nENDPROC\nENDMODULE\n", &[], &[("j", "frame", "another routine"), ("j", "frame", "pdispset")], &["pdispset"]),
    ("two scopes", "rapid", "MODULE m\nPROC a()\nCONST jointtarget j:=@JNT;\nMoveAbsJ j,v9,fine,t;\nENDPROC\nPROC b()\nCONST jointtarget j:=@JNT;\nMoveAbsJ Shifted(j),v9,fine,t;\nENDPROC\nENDMODULE\n", &["j"], &[("j", "unused", "Shifted")], &["Shifted(j)"]),
    ("two scopes", "krl", "DEF a()\nDECL E6AXIS P\nP={@AXS}\nPTP P\nEND\nDEF b()\nDECL E6AXIS P\nP={@AXS}\nPTP_REL P\nEND\n", &["P"], &[("P", "relative", "PTP_REL")], &["relative"]),
    ("two scopes", "urscript", "def a():\n q=@ULI\n movej(q)\nend\ndef b():\n q=[1,2,3]\n x=q\nend\n", &["q"], &[], &[]),
    // A routine that moves to what it is handed.
    ("parameter", "rapid", "PROC go(robtarget p)\nMoveL p,v9,fine,t;\nENDPROC\nPROC main()\nCONST robtarget p:=@ROB;\nCONST robtarget q{2}:=[@ROB,@ROB];\ngo p;\ngo(q{2});\nENDPROC\n", &["p", "q{2}"], &[("q{1}", "unused", "no motion")], &[]),
    ("parameter", "rapid", "PROC main()\nCONST robtarget p:=@ROB;\nCONST robtarget r:=@ROB;\nupper p\\fast;\nmoved r;\nENDPROC\nPROC upper(robtarget a\\switch fast)\nlower 5,a;\nENDPROC\nPROC lower(num n,robtarget b)\nMoveL Offs(b,0,0,n),v9,fine,t;\nMoveL b,v9,fine,t;\nENDPROC\nPROC moved(robtarget c)\nc.trans.z:=c.trans.z+9;\nMoveL c,v9,fine,t;\nENDPROC\n", &["p"], &[("r", "changed", "run time")], &["Offs(b,0,0,n)"]),
    ("parameter", "rapid", "PROC go(robtarget p)\nMoveL RelTool(p,0,0,9),v9,fine,t;\nENDPROC\nPROC main()\nCONST robtarget r:=@ROB;\ngo r;\nother r;\nENDPROC\n", &[], &[("r", "unused", "uses it")], &["RelTool"]),
    ("parameter", "rapid", "PROC go(robtarget p,PERS tooldata u)\nMoveL p,v9,fine,u;\nENDPROC\nPROC main()\nCONST robtarget r:=@ROB;\ngo r,t1;\ngo r,t2;\nENDPROC\n", &[], &[("r", "frame", "u is a parameter")], &[]),
    ("parameter", "rapid", "PROC go(robtarget p)\nMoveL p,v9,fine,t;\nENDPROC\nPROC go(num n)\nENDPROC\nPROC main()\nCONST robtarget r:=@ROB;\ngo r;\nENDPROC\n", &[], &[("r", "unused", "go uses it")], &["p is a parameter"]),
    ("parameter", "rapid", "PROC go(\\switch a|switch b,\\num n,robtarget p,INOUT robtarget q)\nMoveL p,v9,fine,t;\nMoveL RelTool(q,0,0,9),v9,fine,t;\nENDPROC\nPROC main()\nCONST robtarget p1:=@ROB;\nCONST robtarget p2:=@ROB;\ngo \\b,\\n:=5,p1,p2;\nENDPROC\n", &["p1"], &[("p2", "unused", "RelTool uses it")], &["RelTool"]),
    ("parameter", "krl", "DEF m()\nDECL E6POS XP\nXP={@XYZ,@ST}\nGO_TO(XP)\nEND\nDEF GO_TO(P:IN)\nDECL E6POS P\nLIN P\nEND\n", &["XP"], &[], &[]),
    ("parameter", "urscript", "def m():\n def go(q, v=1):\n  movej(q, v=v)\n end\n home=@ULI\n go(home)\n go(home, v=2)\nend\n", &["home"], &[], &[]),
    // A configuration that is not kept: its numbers are those of another one.
    ("configuration", "rapid", "ConfL\\Off;\nConfJ \\Off;\nMoveAbsJ @JNT,v9,fine,t;\nMoveL [[162.222,61.710,586.163],[0.2102361,-0.3256699,0.2949246,-0.8733609],[0,-1,-1,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v9,fine,t;\n", &["target of MoveAbsJ", "target of MoveL"], &[], &[]),
    ("configuration", "rapid", "ConfL\\Off;\nMoveAbsJ @JNT,v9,fine,t;\nMoveJ [[162.222,61.710,586.163],[0.2102361,-0.3256699,0.2949246,-0.8733609],[0,-1,-1,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v9,fine,t;\n", &["target of MoveAbsJ"], &[("target of MoveJ", "unreachable", "configuration")], &[]),
    ("configuration", "rapid", "CONST robtarget p:=[[162.222,61.710,586.163],[0.2102361,-0.3256699,0.2949246,-0.8733609],[0,-1,-1,0],[9E9,9E9,9E9,9E9,9E9,9E9]];\nConfL\\Off;\nMoveAbsJ @JNT,v9,fine,t;\nMoveL p,v9,fine,t;\nConfL\\On;\n", &["target of MoveAbsJ"], &[("p", "unreachable", "configuration")], &[]),
    // What is worked out at run time.
    ("expression", "rapid", "CONST jointtarget j:=[[106,65+1,-25,-63,-53,-18],[9E9,9E9,9E9,9E9,9E9,9E9]];\nMoveAbsJ j,v9,fine,t;\n", &[], &[], &["computed at run time", "j is computed"]),
    ("expression", "krl", "PTP {A1 106+2,A2 65,A3 -25,A4 -63,A5 -53,A6 -18}\nPTP {A1 5}\n", &[], &[], &["from where the robot is", "from where the robot is"]),
    ("expression", "urscript", "def m():\n movej([d2r(9),1,1,1,1,1])\nend\n", &[], &[], &["computed at run time"]),
    ("offset", "rapid", "CONST robtarget p:=@ROB;\nMoveL Offs(p,0,0,9),v9,fine,t;\nMoveL RelTool(p,0,0,9),v9,fine,t;\n", &[], &[("p", "unused", "Offs uses it")], &["Offs(p,0,0,9)", "RelTool"]),
    ("offset", "krl", "DECL FRAME off\noff={X 0,Y 0,Z 9,A 0,B 0,C 0}\nDECL E6POS XP={@XYZ,@ST}\nLIN off:XP\n", &[], &[("XP", "unused", "")], &["off:XP is computed"]),
    ("offset", "urscript", "def m():\n w=@UPO\n movel(pose_trans(w,p[0,0,0.1,0,0,0]))\nend\n", &[], &[], &["pose_trans", "no move of this file uses"]),
    ("offset", "fanuc-ls", "/MN\n 1:L P[1] 9mm/sec FINE Tool_Offset,PR[15] ;\n 2:L P[2] 9mm/sec FINE\n  :  Offset,PR[1] ;\n 3:L PR[1] 9mm/sec FINE ;\n/POS\nP[1]{ GP1: UF : 0, UT : 1, @FXY };\nP[2]{ GP1: UF : 0, UT : 1, @FXY };\n", &[], &[("P[1]", "unused", "TOOL_OFFSET"), ("P[2]", "unused", "OFFSET")], &["TOOL_OFFSET", "(OFFSET)", "PR[…]"]),
    ("computed target", "rapid", "VAR robtarget p:=@ROB;\np:=CRobT();\nMoveL p,v9,fine,t;\n", &[], &[("p", "changed", "run time")], &[]),
    ("computed target", "rapid", "VAR robtarget p:=@ROB;\np.trans.z:=p.trans.z+9;\nMoveL p,v9,fine,t;\n", &[], &[("p", "changed", "run time")], &[]),
    ("computed target", "krl", "DECL E6POS XP={@XYZ,@ST}\nXP.Z=XP.Z+9\nLIN XP\nPTP $AXIS_ACT\n", &[], &[("XP", "changed", "run time")], &["$AXIS_ACT"]),
    ("computed target", "urscript", "def m():\n w=@UPO\n w=get_actual_tcp_pose()\n movel(w)\nend\n", &[], &[("w", "changed", "run time")], &[]),
    ("computed target", "fanuc-ls", "/MN\n 1:P[1]=LPOS ;\n 2:L P[1] 9mm/sec FINE ;\n 3:J P[R[1]] 9% FINE ;\n/POS\nP[1]{ GP1: UF : 0, UT : 1, @FXY };\n", &[], &[("P[1]", "changed", "run time")], &["R[1]"]),
    // Calls.
    ("call", "rapid", "CONST robtarget p:=@ROB;\nPickPart;\nrMove p,v9;\n", &[], &[("p", "unused", "rMove uses it")], &["PickPart"]),
    ("call", "krl", "DEF m()\nPICK( )\nSUB( )\nPTP {@AXS}\nLIN {@XYZ,@ST}\nEND\nDEF SUB( )\n$BASE=BASE_DATA[1]\nEND\n", &["target of PTP"], &[("target of LIN", "frame", "SUB sets it")], &["PICK"]),
    ("call", "urscript", "def m():\n def sub():\n  set_tcp(p[0,0,0.2,0,0,0])\n end\n movel(@UPO)\n sub()\n movel(@UPO)\nend\n", &["target of movel"], &[("target of movel", "frame", "sub sets it")], &[]),
    ("call", "fanuc-ls", "/MN\n 1:CALL PICK(1) ;\n 2:L P[1] 9mm/sec FINE ;\n/POS\nP[1]{ GP1: UF : 0, UT : 1, @FXY };\n", &["P[1]"], &[], &["CALL PICK"]),
    // Branches and loops.
    ("branch", "krl", "IF A==1 THEN\n$BASE=BASE_DATA[1]\nENDIF\nLIN {@XYZ,@ST}\n", &[], &[("target of LIN", "frame", "branch or a loop")], &[]),
    ("loop", "krl", "LOOP\nLIN {@XYZ,@ST}\n$IPO_MODE=#TCP\nENDLOOP\n", &[], &[("target of LIN", "frame", "branch or a loop")], &[]),
    ("loop", "rapid", "PROC main()\nagain:\nIF a THEN\nMoveL @ROB,v9,fine,t;\nPDispSet d;\nENDIF\nGOTO again;\nENDPROC\n", &[], &[("target of MoveL", "frame", "branch or a loop")], &["pdispset"]),
    ("loop", "rapid", "PROC main()\nFOR i FROM 1 TO 9 DO\nagain:\nIF a THEN\nb:=1;\nENDIF\nMoveL @ROB,v9,fine,t;\nPDispSet d;\nENDFOR\nENDPROC\n", &[], &[("target of MoveL", "frame", "branch or a loop")], &["pdispset"]),
    ("loop", "krl", "DEF m()\nagain:\nLIN {@XYZ,@ST}\n$IPO_MODE=#TCP\nGOTO again\nEND\n", &[], &[("target of LIN", "frame", "branch or a loop")], &[]),
    // What may run at any statement, and what goes on from any.
    ("interrupt", "rapid", "MODULE m\nPROC main()\nMoveL @ROB,v9,fine,t;\nENDPROC\nTRAP tr\nPDispSet d;\nENDTRAP\nENDMODULE\n", &[], &[("target of MoveL", "frame", "interrupt")], &["pdispset"]),
    ("interrupt", "rapid", "MODULE m\nPROC main()\nMoveL @ROB,v9,fine,t;\nERROR\nPDispSet d;\nRETRY;\nENDPROC\nENDMODULE\n", &[], &[("target of MoveL", "frame", "handler of errors")], &["pdispset"]),
    ("interrupt", "krl", "DEF a()\nINTERRUPT DECL 3 WHEN $IN[1]==TRUE DO isr()\nLIN {@XYZ,@ST}\nEND\nDEF isr()\n$BASE=BASE_DATA[2]\nEND\n", &[], &[("target of LIN", "frame", "interrupt")], &[]),
    ("interrupt", "krl", "DEF a()\nTRIGGER WHEN DISTANCE=0 DELAY=0 DO isr() PRIO=-1\nPTP {@AXS}\nEND\n", &["target of PTP"], &[], &["isr is another"]),
    ("interrupt", "urscript", "def m():\n thread w():\n  set_tcp(p[0,0,0.1,0,0,0])\n end\n h=run w()\n movel(@UPO)\nend\n", &[], &[("target of movel", "frame", "interrupt")], &[]),
    // A header before the module, arrays of names, a path that a sensor corrects, routines by their names.
    ("header", "rapid", "%%%\n  VERSION:1\n  LANGUAGE:ENGLISH\n%%%\nMODULE m\nCONST robtarget p:=@ROB;\nPROC main()\nMoveL p,v9,fine,t;\n%\"r\"+s%;\nENDPROC\nENDMODULE\n", &["p"], &[], &["%\"r\"+s% is another"]),
    ("array of names", "rapid", "VAR robtarget q{9};\nMoveL q{i},v9,fine,t;\n", &[], &[], &["q is computed"]),
    ("array of names", "krl", "DEF m()\nPTP XP[I]\nEND\n", &[], &[], &["xp is computed"]),
    ("array of names", "rapid", "CONST robtarget p:=@ROB;\nCONST robtarget q{2}:=[p,@ROB];\nMoveL q{2},v9,fine,t;\n", &["q{2}"], &[("p", "unused", "q{1} uses it")], &["q{1} is computed"]),
    ("sensor", "rapid", "MoveL @ROB,v9,fine,t\\WObj:=wobj0\\Corr;\nMoveL @ROB,v9,fine,t;\n", &["target of MoveL"], &[("target of MoveL", "frame", "Corr")], &[]),
    ("sensor", "fanuc-ls", "/MN\n 1:Touch Offset PR[1] ;\n 2:L P[1] 9mm/sec FINE ;\n 3:Touch Offset End ;\n 4:L P[2] 9mm/sec FINE ;\n/POS\nP[1]{ GP1: UF : 0, UT : 1, @FXY };\nP[2]{ GP1: UF : 0, UT : 1, @FXY };\n", &["P[2]"], &[("P[1]", "frame", "Touch shifts")], &["Touch shifts"]),
    ("stationary tool", "fanuc-ls", "/MN\n 1:L P[1] 9mm/sec FINE RTCP ;\n 2:L P[2] 9mm/sec FINE ;\n/POS\nP[1]{ GP1: UF : 1, UT : 2, CONFIG : 'N U T, 0, 0, 0', RX = 1 mm, RY = 2 mm, RZ = 3 mm, RW = 1 deg, RP = 2 deg, RR = 3 deg };\nP[2]{ GP1: UF : 0, UT : 1, @FXY };\n", &["P[2]"], &[], &["RTCP", "P[1]"]),
    ("lines without numbers", "fanuc-ls", "/MN\n    :  !gripper open ;\n    :L P[1] 9mm/sec FINE ;\n    :  !close ;\n    :L P[2] 9mm/sec FINE INC ;\n/POS\nP[1]{ GP1: UF : 0, UT : 1, @FXY };\nP[2]{ GP1: UF : 0, UT : 1, @FXY };\n", &["P[1]"], &[("P[2]", "relative", "INC")], &[]),
    ("stationary tool", "fanuc-ls", "/MN\n 1:L P[1] 9mm/sec FINE RTCP ;\n/POS\nP[1]{ GP1: UF : 0, UT : 1, @FXY };\n", &[], &[("P[1]", "frame", "RTCP")], &[]),
    ("computed target", "fanuc-ls", "/MN\n 1:PR[1]=P[1] ;\n 2:L PR[1] 9mm/sec FINE ;\n/POS\nP[1]{ GP1: UF : 0, UT : 1, @FXY };\n", &[], &[("P[1]", "unused", "PR[1] uses it")], &["PR[…]"]),
    // As a controller lists it whose language is German.
    ("german listing", "fanuc-ls", "/PROG A\n/ATTR\nEIGN.\t= X;\nDEFAULT_GRUP\t= 1,*,*,*,*;\n/MN\n 1:  WKZ_NUM=1 ;\n 2:J P[1] 9% CNT100 ACC100 ZEIT VOR   .10sek,P-SPS    ;\n 3:L P[2] max_Geschw. CNT0 WKZ_Offset ,PR[1]    ;\n 4:L P[3] 9mm/sek CNT0 INK    ;\n 5:  WKZ_NUM=2 ;\n 6:L P[4] 9mm/sek CNT0 Interrupt,LABEL[1]    ;\n 7:  AUFRUF PICK(1) ;\n/POS\nP[1]{ GP1: UF : 0, UT : 1, @FXY };\nP[2]{ GP1: UF : 0, UT : 1, @FXY };\nP[3]{ GP1: UF : 0, UT : 1, @FXY };\nP[4]{ GP1: UF : 0, UT : 1, @FXY };\n", &["P[1]"], &[("P[2]", "unused", "TOOL_OFFSET"), ("P[3]", "unused", "INK"), ("P[4]", "frame", "UTOOL_NUM is 2")], &["TOOL_OFFSET", "INK", "AUFRUF PICK"]),
    ("computed target", "urscript", "def m():\n q=@ULI\n q[5]=q[5]+0.1\n movej(q)\nend\n", &[], &[("q", "changed", "run time")], &[]),
    ("other moves", "urscript", "def m():\n optimovej(@ULI)\n movel(a=1.2, pose=@UPO)\nend\n", &["target of optimovej", "target of movel"], &[], &[]),
    ("numbered frame", "krl", "FDAT_ACT.IPO_FRAME=#TCP\nLIN {@XYZ,@ST}\n", &[], &[("target of LIN", "frame", "FDAT_ACT.IPO_FRAME is set")], &[]),
    // A data list is that of its program.
    ("two data lists", "krl", "DEF a()\nPTP XP1\nEND\nDEF b()\nPTP_REL XP1\nEND\nDEFDAT a\nDECL E6POS XP1={@XYZ,@ST}\nENDDAT\nDEFDAT b\nDECL E6POS XP1={@XYZ,@ST}\nENDDAT\n", &["XP1"], &[("XP1", "relative", "PTP_REL")], &["relative"]),
    ("two data lists", "krl", "DEF a()\nFDAT_ACT=FP1\nPTP XP1\nEND\nDEF b()\nFDAT_ACT=FP1\nPTP XP1\nEND\nDEFDAT a\nDECL E6POS XP1={@XYZ,@ST}\nDECL FDAT FP1={TOOL_NO 0,BASE_NO 0}\nENDDAT\nDEFDAT b\nDECL E6POS XP1={@XYZ,@ST}\nDECL FDAT FP1={TOOL_NO 0,BASE_NO 3}\nENDDAT\n", &["XP1"], &[("XP1", "frame", "BASE_DATA[3]")], &[]),
    // Other ways to write a target.
    ("frame as a target", "krl", "DEF m()\nDECL FRAME XP1\nXP1={@XYZ}\nPTP {@AXS}\nSLIN XP1\nEND\n", &["XP1", "target of PTP"], &[], &[]),
    ("external constant", "rapid", "CONST extjoint ext0:=[9E9,9E9,9E9,9E9,9E9,9E9];\nCONST robtarget p:=[@AT,ext0];\nMoveL p,v9,fine,t;\n", &["p"], &[], &[]),
    ("external constant", "rapid", "CONST robtarget p:=[@AT,ext0];\nMoveL p,v9,fine,t;\n", &[], &[], &["ext0 is computed", "p is computed"]),
    ("base as a target", "krl", "DECL E6POS XP={@XYZ,@ST}\n$BASE=XP\nLIN XP\n", &[], &[("XP", "frame", "a base or a tool as well")], &[]),
];

#[test]
fn nothing_is_corrected_but_what_is_proven_to_be_a_target() {
    for (state, language, program, good, left, listed) in TABLE {
        let text = written(program);
        let what = format!("{state}, {language}:\n{text}");
        let answer = corrected(language, &text, ProgramFrames::as_declared())
            .unwrap_or_else(|error| panic!("{what}\n{error}"));
        let shown: Vec<String> = (answer.targets.iter())
            .map(|target| format!("{}: {:?}", target.name, target.result.as_ref().err()))
            .collect();
        let what = format!("{what}\n{shown:#?}\n{:?}", answer.at_run_time);
        let names = |ok: bool| {
            let own = answer.targets.iter().filter(|t| t.result.is_ok() == ok);
            own.map(|t| t.name.as_str()).collect::<Vec<_>>()
        };
        let (mut found, mut wanted) = (names(true), good.to_vec());
        found.sort_unstable();
        wanted.sort_unstable();
        assert_eq!(found, wanted, "{what}");
        assert_eq!(names(false).len(), left.len(), "{what}");
        for (name, reason, word) in *left {
            let is = |t: &&truepose::programs::Outcome| {
                let Err(left) = &t.result else { return false };
                let says = left.explanation.to_string();
                t.name == *name && left.reason.name() == *reason && says.contains(word)
            };
            assert!(
                answer.targets.iter().any(|t| is(&t)),
                "{name} {word} in {what}"
            );
        }
        for word in *listed {
            let says =
                |(_, _, says): &(u64, u64, truepose::text::Text)| says.to_string().contains(word);
            assert!(answer.at_run_time.iter().any(says), "{word} in {what}");
        }
        assert_eq!(answer.at_run_time.len(), listed.len(), "{what}");
        if found.is_empty() {
            assert_eq!(answer.bytes, text.as_bytes(), "{what}");
        }
    }
}

/// Two targets with external axes at some places.
#[rustfmt::skip]
const AXES_THAT_DIFFER: [(&str, &str, &str); 4] = [
    ("rapid", "eax_a", "CONST robtarget p:=[@AT,[0,9E9,9E9,9E9,9E9,9E9]];\nCONST robtarget r:=[@AT,[1200,9E9,9E9,9E9,9E9,9E9]];\nMoveL p,v9,fine,t;\nMoveL r,v9,fine,t;\nMoveAbsJ @JNT,v9,fine,t;\n"),
    ("krl", "E1", "LIN {@XYZ,@ST,E1 0}\nLIN {@XYZ,@ST,E1 1200}\nPTP {@AXS,E1 0}\n"),
    ("krl", "E2", "PTP {@AXS,E1 1,E2 0}\nPTP {@AXS,E1 1,E2 -3}\nLIN {@XYZ,@ST}\n"),
    ("fanuc-ls", "E1", "/MN\n 1:L P[1] 9mm/sec FINE ;\n 2:L P[2] 9mm/sec FINE ;\n/POS\nP[1]{ GP1: UF : 0, UT : 1, @FXY, E1= 0 mm };\nP[2]{ GP1: UF : 0, UT : 1, @FXY, E1= 900 mm };\n"),
];

#[test]
fn an_external_axis_that_differs_is_a_question_and_both_answers_are_kept() {
    for (language, name, program) in AXES_THAT_DIFFER {
        let text = written(program);
        for frames in [ProgramFrames::as_declared(), ProgramFrames::as_modelled()] {
            let refused = corrected(language, &text, frames);
            let Err(CompensateError::Differs(found)) = refused else {
                panic!("{text}: {refused:?}");
            };
            assert_eq!(
                (found.0.len(), found.0[0].what),
                (1, DifferingNumber::External),
                "{found}"
            );
            let says = found.to_string();
            for part in [name, "--external carries-robot", "other"] {
                assert!(says.contains(part), "{part} in {says}");
            }
        }
        let settled = |external| {
            let frames = ProgramFrames {
                external,
                ..ProgramFrames::as_declared()
            };
            corrected(language, &text, frames).unwrap()
        };
        assert_eq!(settled(ExternalAxes::Other).left(), 0, "{text}");
        // Of joint values the base does not matter; of poses it does.
        for target in settled(ExternalAxes::CarryRobot).targets {
            assert_eq!(target.result.is_err(), target.is_pose, "{text}: {target:?}");
        }
        // Where it stands still it is no question.
        let still = text
            .replace("1200", "0")
            .replace("900", "0")
            .replace("E2 -3", "E2 0");
        assert_eq!(
            corrected(language, &still, ProgramFrames::as_declared())
                .unwrap()
                .left(),
            0
        );
    }
}

#[test]
fn a_quaternion_that_is_no_unit_is_a_typing_error() {
    let text = written("MoveL @ROB,v9,fine,t;\n");
    let long = text.replace("0.2102361", "0.8602361");
    let Err(CompensateError::Rejected(rejected)) =
        corrected("rapid", &long, ProgramFrames::as_declared())
    else {
        panic!("accepted");
    };
    let says = rejected.to_string();
    assert!(
        says.contains("a length of 1.30") && says.contains("line 1"),
        "{says}"
    );
    // Rounded to three digits it is one.
    let short = text.replace("0.2102361", "0.210");
    assert_eq!(
        corrected("rapid", &short, ProgramFrames::as_declared())
            .unwrap()
            .left(),
        0
    );
}
