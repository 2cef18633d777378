MODULE Cell
  ! Four spots on a bracket. Taught off line, in the base.
  PERS tooldata tSpot:=[TRUE,[[80,0,0],[1,0,0,0]],[2,[0,0,40],[1,0,0,0],0,0,0]];
  CONST jointtarget jHome:=[[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST jointtarget jBefore:=[[-20,30,15,10,30,-8],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget pWeld10:=[[429.014,-181.632,270.607],[0.7410193,0.1799590,0.6349120,-0.1240640],[-1,0,-1,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget pWeld20:=[[479.454,-87.525,252.911],[0.7539542,0.0915535,0.6484710,-0.0515407],[-1,0,-1,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget pWeld30:=[[499.604,22.798,241.593],[0.7608157,-0.0331816,0.6480917,0.0059651],[0,-1,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget pWeld40:=[[470.581,136.608,240.756],[0.7473577,-0.1237813,0.6482515,0.0768423],[0,-1,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];

  PROC main()
    MoveAbsJ jHome,v1000,z50,tSpot;
    MoveAbsJ jBefore,v1000,fine,tSpot;
    MoveL pWeld10,v200,fine,tSpot;
    MoveL pWeld20,v200,fine,tSpot;
    MoveL pWeld30,v200,fine,tSpot;
    MoveL Offs(pWeld30,0,0,15),v200,z1,tSpot;
    MoveL pWeld40,v200,fine,tSpot;
    MoveAbsJ jHome,v1000,z50,tSpot;
  ENDPROC
ENDMODULE
