// SPDX-License-Identifier: AGPL-3.0-or-later
// What STEP files are written from and read into: a document of XCAF, closed when it goes.
#pragma once

#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <Standard_Failure.hxx>
#include <TDocStd_Document.hxx>
#include <XCAFApp_Application.hxx>
#include <XCAFDoc_DocumentTool.hxx>
#include <XCAFDoc_ShapeTool.hxx>

struct CwStepDocument {
  Handle(TDocStd_Document) handle;
  Handle(XCAFDoc_ShapeTool) shapes;

  CwStepDocument() {
    Message::DefaultMessenger()->ChangePrinters().Clear(); // else the translator chats on standard output
    XCAFApp_Application::GetApplication()->NewDocument("BinXCAF", handle);
    shapes = XCAFDoc_DocumentTool::ShapeTool(handle->Main());
  }
  ~CwStepDocument() {
    try {
      XCAFApp_Application::GetApplication()->Close(handle);
    } catch (const Standard_Failure &) { // nothing is left to do about it
    }
  }
};
